// What the page asks of relock, and the pictures that it has been given already.

const kKept = 80; // pictures

export class Refused extends Error {}

async function told(response) {
  if (response.ok) return response;
  throw new Refused((await response.text()).trim());
}

export class Server {
  #pictures = new Map();
  #last = Promise.resolve();

  async #ask(path, options) {
    let response;
    try {
      response = await fetch(path, options);
    } catch {
      throw new Refused("relock label does not answer. What was shown as saved is saved: start it again, and open its new link.");
    }
    return told(response);
  }

  async state() {
    return (await this.#ask("state")).json();
  }

  /// Edits go one after another, in the order in which they were made. The new state, which is on disk by then.
  edit(request) {
    const next = this.#last.then(async () =>
      (await this.#ask("edit", { method: "POST", body: JSON.stringify(request) })).json());
    this.#last = next.catch(() => {});
    return next;
  }

  /// What the detector says of a frame.
  async answers(frame) {
    return (await this.#ask(`answers/${frame}`)).json();
  }

  /// An ImageBitmap, in time.
  picture(frame) {
    let picture = this.#pictures.get(frame);
    if (!picture) {
      picture = this.#ask(`picture/${frame}`)
        .then((response) => response.blob())
        .then(createImageBitmap);
      picture.catch(() => this.#pictures.delete(frame));
      this.#pictures.set(frame, picture);
      if (this.#pictures.size > kKept) this.#forget(frame);
    }
    return picture;
  }

  #forget(near) {
    let farthest = near;
    for (const frame of this.#pictures.keys()) if (Math.abs(frame - near) > Math.abs(farthest - near)) farthest = frame;
    const picture = this.#pictures.get(farthest);
    this.#pictures.delete(farthest);
    picture.then((bitmap) => bitmap.close?.(), () => {});
  }
}

#include "cli/labelling/server.h"

#include <fmt/format.h>
#include <httplib.h>
#include <netinet/tcp.h>
#include <sys/random.h>

#include <array>
#include <charconv>
#include <opencv2/imgcodecs.hpp>

#include "cli/labelling/likeness.h"
#include "cli/labelling/page.h"
#include "cli/labelling/shelf.h"
#include "core/error.h"
#include "core/opencv.h"

namespace relock {
namespace {

constexpr const char* kLoopback = "127.0.0.1";
constexpr std::size_t kMostAsked = 1 << 20;  // bytes of a request
constexpr const char* kPolicy =
    "default-src 'none'; script-src 'self'; style-src 'self'; img-src 'self' blob:; connect-src 'self'; "
    "base-uri "
    "'none'; form-action 'none'; frame-ancestors 'none'";

std::string random_token() {
  std::array<unsigned char, 16> bytes;
  if (getrandom(bytes.data(), bytes.size(), 0) != static_cast<ssize_t>(bytes.size()))
    throw Error("the system has no random numbers for the link");
  std::string token;
  for (const unsigned char byte : bytes) token += fmt::format("{:02x}", byte);
  return token;
}

/// Takes the same time wherever the difference is.
bool same_secret(std::string_view a, std::string_view b) {
  if (a.size() != b.size()) return false;
  unsigned char different = 0;
  for (std::size_t i = 0; i < a.size(); ++i) different |= static_cast<unsigned char>(a[i] ^ b[i]);
  return different == 0;
}

void refuse(httplib::Response& response, int status, const std::string& sentence) {
  response.status = status;
  response.set_content(sentence + "\n", "text/plain; charset=utf-8");
}

void answer(httplib::Response& response, const Json& json) {
  response.set_content(json.dump(-1, ' ', false, Json::error_handler_t::replace), "application/json");
}

}  // namespace

struct LabelServer::Parts {
  Parts(LabelDesk& of, std::unique_ptr<Helper> help, const PageOptions& chosen)
      : desk(of),
        helper(std::move(help)),
        options(chosen),
        shelf(of.sequence().frames),
        watch(of.sequence().frames) {}

  LabelDesk& desk;
  std::unique_ptr<Helper> helper;
  PageOptions options;
  std::mutex mutex;  // the library answers from several threads; desk, shelf and helper know one
  PictureShelf shelf;
  LikenessWatch watch;
  httplib::Server server;
  std::string token = random_token(), host, origin, link;

  void watch_labels() { watch.look_at_labels(desk.document().targets, desk.filled(), desk.version()); }

  Json state() {
    Json json = desk.state(watch.known());
    json["looking"] = !watch.finished();
    json["sigma_px"] = options.sigma_px;
    json["helper"] = helper ? Json(helper->name) : Json();
    return json;
  }

  /// Whether a request may be answered at all. Browsers tell where a request comes from; a name that somebody made to
  /// point here shows in the host.
  bool allowed(const httplib::Request& request, httplib::Response& response) const {
    response.set_header("Content-Security-Policy", kPolicy);
    response.set_header("Referrer-Policy", "no-referrer");
    response.set_header("X-Content-Type-Options", "nosniff");
    response.set_header("Cross-Origin-Resource-Policy", "same-origin");
    response.set_header("Cache-Control", "no-store");
    const std::string_view path = request.path;
    const std::size_t end = path.find('/', 1);
    const bool knows =
        path.starts_with('/') && end != std::string_view::npos && same_secret(path.substr(1, end - 1), token);
    if (!knows || request.get_header_value("Host") != host) {
      refuse(response, 403, "This link is not the one that relock label printed; open that one.");
      return false;
    }
    const bool from_elsewhere = request.has_header("Origin") && request.get_header_value("Origin") != origin;
    const std::string site = request.get_header_value("Sec-Fetch-Site");
    if (from_elsewhere || site == "cross-site" || site == "same-site") {
      refuse(response, 403, "Another page has no business here.");
      return false;
    }
    return true;
  }

  void set_up() {
    server.set_payload_max_length(kMostAsked);
    server.set_tcp_nodelay(true);
    server.set_pre_routing_handler([this](const httplib::Request& request, httplib::Response& response) {
      return allowed(request, response) ? httplib::Server::HandlerResponse::Unhandled
                                        : httplib::Server::HandlerResponse::Handled;
    });
    server.set_exception_handler(
        [](const httplib::Request&, httplib::Response& response, std::exception_ptr thrown) {
          try {
            std::rethrow_exception(thrown);
          } catch (const Error& fault) {
            refuse(response, 422, fault.what());
          } catch (const Json::exception&) {
            refuse(response, 400, "This is no request of the labelling page.");
          } catch (const std::exception& fault) {
            refuse(response, 500, fault.what());
          }
        });
    for (const PageFile& file : label_page())
      server.Get(at(file.name), [&file](const httplib::Request&, httplib::Response& response) {
        response.set_content(std::string(file.text), std::string(file.kind));
      });
    server.Get(at("state"), [this](const httplib::Request&, httplib::Response& response) {
      const std::lock_guard lock(mutex);
      answer(response, state());
    });
    server.Get(at("picture/(\\d{1,9})"),
               [this](const httplib::Request& request, httplib::Response& response) {
                 show(static_cast<std::size_t>(std::stoul(request.matches[1])), response);
               });
    server.Get(at("answers/(\\d{1,9})"),
               [this](const httplib::Request& request, httplib::Response& response) {
                 ask_helper(static_cast<std::size_t>(std::stoul(request.matches[1])), response);
               });
    server.Post(at("edit"), [this](const httplib::Request& request, httplib::Response& response) {
      const std::lock_guard lock(mutex);
      desk.edit(Json::parse(request.body));
      watch_labels();
      answer(response, state());
    });
  }

  std::string at(std::string_view name) const { return fmt::format("/{}/{}", token, name); }

  void check_frame(std::size_t frame) const {
    if (frame >= desk.sequence().recording.frames()) throw Error(fmt::format("there is no frame {}", frame));
  }

  void show(std::size_t frame, httplib::Response& response) {
    check_frame(frame);
    std::vector<std::uint8_t> png;
    const std::lock_guard lock(mutex);
    // Without loss: labels are placed to the pixel. Fast rather than small: it goes no farther than this machine.
    cv::imencode(".png", shelf.picture(frame), png, {cv::IMWRITE_PNG_COMPRESSION, 1});
    response.set_content(std::string(png.begin(), png.end()), "image/png");
  }

  void ask_helper(std::size_t frame, httplib::Response& response) {
    check_frame(frame);
    if (!helper) throw Error("no detector was named; start relock label with --detector NAME");
    Json answers = Json::array();
    const std::lock_guard lock(mutex);
    for (const Sighting& sighting : helper->detector->detect(view(shelf.picture(frame)))) {
      Json one{{"code", sighting.code ? Json(to_string(*sighting.code)) : Json()}};
      add_outline(one, sighting.outline);
      answers.push_back(one);
    }
    answer(response, answers);
  }
};

LabelServer::LabelServer(LabelDesk& desk, std::unique_ptr<Helper> helper, const PageOptions& options)
    : parts_(std::make_unique<Parts>(desk, std::move(helper), options)) {
  httplib::Server& server = parts_->server;
  server.set_socket_options([](int socket) {  // the library's own let another program share the port
    const int yes = 1;
    setsockopt(socket, SOL_SOCKET, SO_REUSEADDR, &yes, sizeof yes);
  });
  int port = options.port;
  if (port == 0) {
    port = server.bind_to_any_port(kLoopback);
  } else if (!server.bind_to_port(kLoopback, port)) {
    port = -1;
  }
  if (port < 0)
    throw Error(
        fmt::format("port {} of this machine is taken; choose another --port, or none", options.port));
  parts_->host = fmt::format("{}:{}", kLoopback, port);
  parts_->origin = "http://" + parts_->host;
  parts_->link = fmt::format("{}/{}/", parts_->origin, parts_->token);
  parts_->set_up();
  parts_->watch_labels();
}

LabelServer::~LabelServer() = default;

const std::string& LabelServer::link() const { return parts_->link; }
void LabelServer::serve() { parts_->server.listen_after_bind(); }
void LabelServer::stop() { parts_->server.stop(); }

}  // namespace relock

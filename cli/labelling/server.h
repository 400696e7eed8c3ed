#pragma once

#include <functional>
#include <memory>
#include <string>

#include "cli/labelling/desk.h"
#include "core/detector.h"

namespace relock {

/// A method whose answers may be taken over as labels.
struct Helper {
  std::string name;  ///< as labels state it
  std::unique_ptr<Detector> detector;
};

struct PageOptions {
  std::uint16_t port = 0;  ///< 0: any that is free
  double sigma_px = 1.0;   ///< of what is placed by hand at the picture's own size
};

/// The labelling page, over HTTP on the loopback address alone. Everything is below a random path that only the link
/// tells, and only the page itself is answered: another page's requests (of another origin), another name for this
/// machine, and any other path are refused. No path names a file: pictures are asked for by number.
class LabelServer {
 public:
  /// Throws Error when the port is taken.
  LabelServer(LabelDesk& desk, std::unique_ptr<Helper> helper, const PageOptions& options);
  ~LabelServer();

  /// "http://127.0.0.1:PORT/TOKEN/".
  const std::string& link() const;
  /// Until stop() is called from another thread, or for ever.
  void serve();
  void stop();

 private:
  struct Parts;
  std::unique_ptr<Parts> parts_;
};

}  // namespace relock

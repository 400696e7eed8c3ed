#pragma once

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <functional>
#include <string>
#include <string_view>

#include "core/error.h"
#include "core/random.h"

namespace relock {

/// A text with a few things wrong: bytes changed, put in or lost, numbers replaced by odd ones, lines doubled,
/// exchanged or cut off.
inline std::string mangled(std::string text, Random& random) {
  constexpr std::string_view kOdd[] = {"nan", "inf", "-1",  "1e999", "9223372036854775808",
                                       "",    "\"",  "\0x", ",,",    "0x10"};
  for (std::uint64_t wrongs = 1 + random.below(3); wrongs > 0 && !text.empty(); --wrongs) {
    const std::size_t at = random.below(text.size());
    const std::size_t line = text.rfind('\n', at) == std::string::npos ? 0 : text.rfind('\n', at) + 1;
    const std::size_t end = std::min(text.find('\n', at), text.size());
    switch (random.below(6)) {
      case 0:
        text[at] = static_cast<char>(random.below(256));
        break;
      case 1:
        text.erase(at, 1 + random.below(8));
        break;
      case 2:
        text.insert(at, kOdd[random.below(std::size(kOdd))]);
        break;
      case 3: {
        const std::size_t cell = text.find_first_of(",\n", at);
        if (cell != std::string::npos) text.replace(at, cell - at, kOdd[random.below(std::size(kOdd))]);
        break;
      }
      case 4:
        text.insert(line, text.substr(line, end - line) + "\n");
        break;
      default:
        text.resize(at);
    }
  }
  return text;
}

/// Reads thousands of mangled copies of a text that is right: each is taken, or refused with an Error that names
/// the file. Anything else (another exception, a crash, a sanitizer's complaint) fails the test.
inline void expect_taken_or_refused(const std::string& right, std::string_view file,
                                    const std::function<void(const std::string&)>& read, int copies = 3000) {
  read(right);
  Random random(1);
  int refused = 0;
  for (int copy = 0; copy < copies; ++copy) {
    const std::string text = mangled(right, random);
    try {
      read(text);
    } catch (const Error& fault) {
      ++refused;
      EXPECT_NE(std::string_view(fault.what()).find(file), std::string_view::npos) << fault.what();
    } catch (const std::exception& fault) {
      ADD_FAILURE() << fault.what() << "\nreading\n" << text;
      return;
    }
  }
  EXPECT_GT(refused, copies / 10);
}

}  // namespace relock

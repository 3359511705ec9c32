#pragma once
// What every study that runs bouts is told besides its question.

#include <atomic>
#include <functional>
#include <string>

namespace ringcraft {

struct StudyRun {
  int threads = 1;                                    // never changes the result
  const std::atomic<bool>* interrupted = nullptr;     // what is finished is kept
  std::function<void(const std::string&)> said = {};  // progress, a line at a time

  bool stopped() const { return interrupted != nullptr && interrupted->load(); }
  void say(const std::string& line) const {
    if (said) said(line);
  }
};

}  // namespace ringcraft

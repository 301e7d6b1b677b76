#pragma once

#include <functional>
#include <string>
#include <thread>

namespace drape {

/// Tells a terminal, after three seconds, what takes so long and has no frames to count: a mesh of a million triangles
/// is read for ten and more. It ends with this object.
class SlowNotice {
  public:
    /// `say` receives the text in a thread of its own, at most once, and never when stderr is no terminal.
    SlowNotice(std::string text, std::function<void(const std::string&)> say);

  private:
    std::jthread waiting_;
};

}  // namespace drape

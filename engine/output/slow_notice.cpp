#include "output/slow_notice.h"

#include <unistd.h>

#include <chrono>
#include <condition_variable>
#include <mutex>
#include <utility>

namespace drape {

SlowNotice::SlowNotice(std::string text, std::function<void(const std::string&)> say) {
    if (isatty(STDERR_FILENO) == 0) return;
    waiting_ = std::jthread([text = std::move(text), say = std::move(say)](const std::stop_token& ended) {
        std::mutex mutex;
        std::unique_lock lock(mutex);
        std::condition_variable_any changed;
        changed.wait_for(lock, ended, std::chrono::seconds(3), [] { return false; });
        if (!ended.stop_requested()) say(text);
    });
}

}  // namespace drape

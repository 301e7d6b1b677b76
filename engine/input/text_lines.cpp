#include "input/text_lines.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>

namespace drape::input {

bool Lines::next(std::string_view& line) {
    constexpr std::size_t most_line = std::size_t{1} << 20;
    ++number_;
    for (std::size_t seen = begin_;;) {
        std::size_t stop = seen;
        while (stop < text_.size() && text_[stop] != '\n' && text_[stop] != '\r') ++stop;
        // What follows a carriage return says whether it ends the line alone.
        const bool is_known = stop < text_.size() && (text_[stop] == '\n' || stop + 1 < text_.size());
        if (is_known || (ended_ && begin_ < text_.size())) {
            line = std::string_view(text_).substr(begin_, stop - begin_);
            begin_ = stop + (text_.compare(stop, 2, "\r\n") == 0 ? 2 : 1);
            return true;
        }
        if (ended_) return false;
        text_.erase(0, begin_);
        begin_ = 0;
        const std::size_t had = text_.size();
        seen = had - (text_.ends_with('\r') ? 1 : 0);
        if (had > most_line) throw unreadable(file_.name(), fmt::format("line {} is too long", number_));
        text_.resize(had + 65536);
        text_.resize(had + file_.read(text_.data() + had, 65536));
        ended_ = text_.size() == had;
        if (number_ == 1 && had == 0 && text_.starts_with("\xEF\xBB\xBF")) begin_ = seen = 3;
    }
}

bool read_vertex(std::string_view line, std::array<double, 3>& vertex) {
    constexpr std::string_view blanks = " \t\r";
    for (double& x : vertex) {
        line.remove_prefix(std::min(line.find_first_not_of(blanks), line.size()));
        if (line.starts_with('+')) line.remove_prefix(1);
        const auto [end, error] = std::from_chars(line.data(), line.data() + line.size(), x);
        if (error != std::errc{}) return false;
        line.remove_prefix(static_cast<std::size_t>(end - line.data()));
        if (!line.empty() && blanks.find(line.front()) == blanks.npos) return false;
    }
    return true;
}

}  // namespace drape::input

#include "help_text.h"

#include <algorithm>

namespace drape::cli {

namespace {

/// Takes the text up to the next `separator` off `text`, with the separator, and returns it.
std::string_view take(std::string_view& text, char separator) {
    const std::size_t end = std::min(text.find(separator), text.size());
    const std::string_view part = text.substr(0, end);
    text.remove_prefix(std::min(end + 1, text.size()));
    return part;
}

std::string wrapped_line(std::string_view line, std::size_t columns) {
    const std::size_t gap = line.find("  ");
    const std::size_t hang = gap == std::string_view::npos ? 0 : line.find_first_not_of(' ', gap);
    std::string text(line.substr(0, hang));
    std::size_t column = hang;
    for (line.remove_prefix(hang); !line.empty();) {
        const std::string_view word = take(line, ' ');
        if (column > hang && column + 1 + word.size() > columns) {
            text += '\n' + std::string(hang, ' ');
            column = hang;
        } else if (column > hang) {
            text += ' ';
            ++column;
        }
        text += word;
        column += word.size();
    }
    return text;
}

}  // namespace

std::string wrapped(std::string_view text, std::size_t columns) {
    std::string lines;
    do lines += wrapped_line(take(text, '\n'), columns) + '\n';
    while (!text.empty());
    lines.pop_back();
    return lines;
}

std::string reflowed(std::string_view text, std::size_t columns) {
    std::string lines, paragraph;
    const auto end_paragraph = [&] {
        if (!paragraph.empty()) lines += wrapped_line(paragraph, columns) + '\n';
        paragraph.clear();
    };
    while (!text.empty()) {
        const std::string_view line = take(text, '\n');
        if (line.empty() || line.starts_with(' ')) {
            end_paragraph();
            lines.append(line) += '\n';
        } else {
            paragraph.append(paragraph.empty() ? "" : " ").append(line);
        }
    }
    end_paragraph();
    return lines;
}

}  // namespace drape::cli

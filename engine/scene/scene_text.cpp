#include "scene/scene_text.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <vector>

namespace drape {
namespace {

bool is_digit(char c) { return c >= '0' && c <= '9'; }
bool continues_number(char c) { return is_digit(c) || c == '-' || c == '+' || c == '.' || c == 'e' || c == 'E'; }

// A number is [-] (0 | 1-9 digits) [. digits] [e|E [+|-] digits].
bool is_json_number(std::string_view token) {
    std::size_t i = 0;
    const auto digits = [&] {
        const std::size_t from = i;
        while (i < token.size() && is_digit(token[i])) ++i;
        return i > from;
    };
    if (i < token.size() && token[i] == '-') ++i;
    if (i < token.size() && token[i] == '0') {
        ++i;
    } else if (!digits()) {
        return false;
    }
    if (i < token.size() && token[i] == '.') {
        ++i;
        if (!digits()) return false;
    }
    if (i < token.size() && (token[i] == 'e' || token[i] == 'E')) {
        ++i;
        if (i < token.size() && (token[i] == '+' || token[i] == '-')) ++i;
        if (!digits()) return false;
    }
    return i == token.size();
}

// Returns the bytes of the UTF-8 sequence that begins at `text`, 0 when it is none (overlong, surrogate, cut off).
std::size_t utf8_length(std::string_view text) {
    const auto byte = [&](std::size_t i) { return static_cast<unsigned char>(text[i]); };
    const unsigned lead = byte(0);
    if (lead < 0x80) return 1;
    const std::size_t length = lead >= 0xF0 ? 4 : lead >= 0xE0 ? 3 : 2;
    if (lead < 0xC2 || lead > 0xF4 || length > text.size()) return 0;
    for (std::size_t i = 1; i < length; ++i)
        if ((byte(i) & 0xC0) != 0x80) return 0;
    const unsigned second = byte(1);
    if ((lead == 0xE0 && second < 0xA0) || (lead == 0xED && second > 0x9F)) return 0;
    if ((lead == 0xF0 && second < 0x90) || (lead == 0xF4 && second > 0x8F)) return 0;
    return length;
}

std::optional<TextFault> find_byte_fault(std::string_view text) {
    for (std::size_t i = 0; i < text.size();) {
        const auto byte = static_cast<unsigned char>(text[i]);
        if ((byte < 0x20 && byte != '\t' && byte != '\n' && byte != '\r') || byte == 0x7F)
            return TextFault{i, fmt::format("expected text, got the control character 0x{:02X}", byte)};
        const std::size_t length = utf8_length(text.substr(i));
        if (length == 0) return TextFault{i, fmt::format("expected UTF-8 text, got the byte 0x{:02X}", byte)};
        i += length;
    }
    return std::nullopt;
}

enum class TokenKind { string, unclosed_string, number, other };

struct Token {
    TokenKind kind;
    std::size_t begin;
    std::size_t end;
};

// Cuts a text into strings, numbers and single other characters (of which blanks count as other); skips
// comments. Never fails: what is no JSON comes out as tokens all the same.
class TokenScanner {
  public:
    explicit TokenScanner(std::string_view text) : text_(text) {}

    std::optional<Token> next() {
        while (at_ < text_.size() && skip_comment()) {
        }
        if (at_ == text_.size()) return std::nullopt;
        const std::size_t begin = at_;
        const char c = text_[at_++];
        if (c == '"') return Token{close_string(), begin, at_};
        if (!is_digit(c) && c != '-' && c != '+' && c != '.') return Token{TokenKind::other, begin, at_};
        while (at_ < text_.size() && continues_number(text_[at_])) ++at_;
        return Token{TokenKind::number, begin, at_};
    }

  private:
    bool skip_comment() {
        const std::string_view opening = text_.substr(at_, 2);
        if (opening == "//") {
            at_ = std::min(text_.find_first_of("\r\n", at_), text_.size());
            return true;
        }
        if (opening != "/*") return false;
        const std::size_t end = text_.find("*/", at_ + 2);
        at_ = end == std::string_view::npos ? text_.size() : end + 2;
        return true;
    }

    TokenKind close_string() {
        for (; at_ < text_.size() && text_[at_] != '\n' && text_[at_] != '\r'; ++at_) {
            if (text_[at_] == '"') {
                ++at_;
                return TokenKind::string;
            }
            if (text_[at_] == '\\' && at_ + 1 < text_.size()) ++at_;
        }
        return TokenKind::unclosed_string;
    }

    std::string_view text_;
    std::size_t at_ = 0;
};

/// Counts what is nested, and what there is, by brackets and commas alone.
class Counter {
  public:
    /// Returns what is too much with this character.
    std::optional<std::string> take(char c) {
        if (c == '{' || c == '[') {
            if (open_.size() == static_cast<std::size_t>(scene_depth_limit))
                return fmt::format("expected at most {} nested arrays and objects", scene_depth_limit);
            open_.push_back({c == '{', 0});
            ++values_;
        } else if (c == '}' || c == ']') {
            if (!open_.empty()) open_.pop_back();
        } else if (c == ',' && !open_.empty()) {
            ++values_;
            if (++open_.back().commas >= scene_key_limit && open_.back().is_object)
                return fmt::format("expected at most {} keys in an object", scene_key_limit);
        }
        if (values_ <= scene_value_limit) return std::nullopt;
        return fmt::format("expected a scene of at most {} values", scene_value_limit);
    }

  private:
    struct Open {
        bool is_object;
        std::size_t commas;
    };
    std::vector<Open> open_;
    std::size_t values_ = 0;
};

std::optional<TextFault> find_token_fault(std::string_view text) {
    Counter counter;
    TokenScanner scanner(text);
    while (const auto token = scanner.next()) {
        const std::string_view word = text.substr(token->begin, token->end - token->begin);
        if (token->kind == TokenKind::unclosed_string)
            return TextFault{token->begin, "expected a closing quote on the same line"};
        if (token->kind == TokenKind::number && !is_json_number(word))
            return TextFault{token->begin, fmt::format("expected a JSON number, got {}", shortened(word))};
        if (token->kind != TokenKind::other) continue;
        if (auto too_much = counter.take(word[0])) return TextFault{token->begin, std::move(*too_much)};
    }
    return std::nullopt;
}

void append_utf8(std::string& out, unsigned code) {
    const auto put = [&](unsigned byte) { out.push_back(static_cast<char>(byte)); };
    if (code < 0x80) {
        put(code);
    } else if (code < 0x800) {
        put(0xC0 | (code >> 6));
        put(0x80 | (code & 0x3F));
    } else {
        put(0xE0 | (code >> 12));
        put(0x80 | ((code >> 6) & 0x3F));
        put(0x80 | (code & 0x3F));
    }
}

// Resolves the escapes of a key. A pair of surrogates is left as two code units: such a key is known to no table, and
// only its place is then reported less exactly.
std::string unescaped(std::string_view quoted) {
    std::string key;
    for (std::size_t i = 1; i + 1 < quoted.size(); ++i) {
        if (quoted[i] != '\\') {
            key.push_back(quoted[i]);
            continue;
        }
        const char escape = quoted[++i];
        constexpr std::string_view letters = "bfnrt";
        constexpr std::string_view meanings = "\b\f\n\r\t";
        if (escape == 'u' && i + 4 < quoted.size()) {
            append_utf8(key, static_cast<unsigned>(std::stoul(std::string(quoted.substr(i + 1, 4)), nullptr, 16)));
            i += 4;
        } else if (const std::size_t letter = letters.find(escape); letter != std::string_view::npos) {
            key.push_back(meanings[letter]);
        } else {
            key.push_back(escape);
        }
    }
    return key;
}

}  // namespace

LineTable::LineTable(std::string_view text) : size_(text.size()) {
    for (std::size_t i = 0; i < text.size(); ++i) {
        const bool ends = text[i] == '\n' || (text[i] == '\r' && !(i + 1 < text.size() && text[i + 1] == '\n'));
        if (ends) starts_.push_back(i + 1);
    }
}

LineColumn LineTable::at(std::size_t offset) const {
    const auto after = std::upper_bound(starts_.begin(), starts_.end(), offset);
    return {static_cast<std::uint32_t>(after - starts_.begin()), static_cast<std::uint32_t>(offset - after[-1] + 1)};
}

std::size_t LineTable::offset_of(LineColumn place) const {
    const std::size_t line = std::clamp<std::size_t>(place.line, 1, starts_.size());
    return std::min(starts_[line - 1] + std::max(place.column, 1u) - 1, size_);
}

std::string shortened(std::string_view text, std::size_t most) {
    if (text.size() <= most) return std::string(text);
    std::size_t end = most - 3;
    while (end > 0 && (static_cast<unsigned char>(text[end]) & 0xC0) == 0x80) --end;
    return std::string(text.substr(0, end)) + "...";
}

std::optional<TextFault> find_text_fault(std::string_view text) {
    if (auto fault = find_byte_fault(text)) return fault;
    return find_token_fault(text);
}

std::string with_finite_numbers(std::string_view text) {
    std::string finite(text);
    TokenScanner scanner(text);
    while (const auto token = scanner.next()) {
        if (token->kind != TokenKind::number) continue;
        const std::string word(text.substr(token->begin, token->end - token->begin));
        const bool may_overflow = word.size() > 300 || word.find_first_of("eE") != std::string::npos;
        if (!may_overflow || std::isfinite(std::strtod(word.c_str(), nullptr))) continue;
        const std::string sign = word[0] == '-' ? "-" : "";
        // No number that overflows is shorter than the 5 characters of 1e308.
        const std::string filling(word.size() - sign.size() - 5, '0');
        finite.replace(token->begin, word.size(), fmt::format("{}1e{}308", sign, filling));
    }
    return finite;
}

std::vector<std::size_t> trailing_commas(std::string_view text) {
    std::vector<std::size_t> commas;
    constexpr std::size_t none = std::string_view::npos;
    std::size_t comma = none;
    char before = '[';  // while there is nothing, a comma ends no member
    TokenScanner scanner(text);
    while (const auto token = scanner.next()) {
        const char c = token->kind == TokenKind::other ? text[token->begin] : '"';
        if (c == ' ' || c == '\t' || c == '\n' || c == '\r') continue;
        if (comma != none && (c == '}' || c == ']')) commas.push_back(comma);
        comma = c == ',' && before != ',' && before != '[' && before != '{' ? token->begin : none;
        before = c;
    }
    return commas;
}

std::map<std::string, std::size_t> key_offsets(std::string_view object) {
    std::map<std::string, std::size_t> offsets;
    int depth = 0;
    bool key_expected = false;
    TokenScanner scanner(object);
    while (const auto token = scanner.next()) {
        if (token->kind == TokenKind::string && depth == 1 && key_expected) {
            offsets.emplace(unescaped(object.substr(token->begin, token->end - token->begin)), token->begin);
            key_expected = false;
        }
        if (token->kind != TokenKind::other) continue;
        const char c = object[token->begin];
        depth += (c == '{' || c == '[') - (c == '}' || c == ']');
        if (depth == 0 && c == '}') break;
        if (c == '{' || c == ',') key_expected = depth == 1;
    }
    return offsets;
}

}  // namespace drape

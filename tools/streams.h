// Data goes to stdout and messages to stderr, also when one of them is closed, full or a broken pipe.
#pragma once

#include <string>
#include <string_view>

namespace drape::cli {

/// Thrown when stdout's reader has gone (`drape graph ... | head`); it leads to exit code 1 and no message.
struct ReaderGone {};

/// Call first in main. A closed standard stream becomes one that fails, so that no result file ever gets its
/// number and messages written into it; a broken pipe becomes an error instead of a death half-way.
void prepare_streams();

/// Writes to stdout, at once. Throws OutputError when it cannot be written whole, ReaderGone on a broken pipe.
void print_data(std::string_view text);

/// Writes a text to a file. Never replaces one, and leaves none half-written. Throws OutputError.
void create_file(const std::string& path, std::string_view text);

/// Writes a line to stderr, its control characters (but for line ends) and bytes that are not UTF-8 as \x1b. It never
/// fails: there is nowhere to say so.
void print_message(std::string_view text);

/// Writes a line to stderr that tells of an error.
void print_error(std::string_view text);

}  // namespace drape::cli

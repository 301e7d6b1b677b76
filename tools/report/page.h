// What all pages of a report have in common.
#pragma once

#include <string>

namespace drape::report {

/// Returns a whole page, well-formed as XML too. `title` is plain text, `body` and `scripts` are markup.
std::string page_of(const std::string& title, const std::string& body, const std::string& scripts = {});

}  // namespace drape::report

#include "base/printable_text.h"

#include <gtest/gtest.h>

#include "output/json_text.h"
#include "output/xml_text.h"

namespace drape {
namespace {

TEST(PrintableText, CharactersOfUtf8StayAndOtherBytesAreSpelt) {
    for (const std::string good :
         {"plain", "\xc3\xa9", "\xe2\x82\xac", "\xf0\x9f\xa7\xb5", "\xed\x9f\xbf", "\xf4\x8f\xbf\xbf"})
        EXPECT_EQ(printable(good), good);
    EXPECT_EQ(printable("a\xff"), "a\\xff");
    EXPECT_EQ(printable("\xc0\x80"), "\\xc0\\x80") << "longer than it need be";
    EXPECT_EQ(printable("\xe0\x9f\xbf"), "\\xe0\\x9f\\xbf") << "likewise";
    EXPECT_EQ(printable("\xed\xa0\x80"), "\\xed\\xa0\\x80") << "a surrogate";
    EXPECT_EQ(printable("\xf4\x90\x80\x80"), "\\xf4\\x90\\x80\\x80") << "beyond the last";
    EXPECT_EQ(printable("\xe2\x82"), "\\xe2\\x82") << "cut short";
    EXPECT_EQ(printable("\xe2\x82z"), "\\xe2\\x82z");
    EXPECT_EQ(printable(""), "");
}

TEST(PrintableText, ControlCharactersAreSpeltAsFarAsAsked) {
    const std::string text = "\x1b[1m\n\t\x7f\xc2\x9b\xff";
    EXPECT_EQ(printable(text), "\\x1b[1m\\x0a\\x09\\x7f\\xc2\\x9b\\xff");
    EXPECT_EQ(printable(text, Escaped::controls), "\\x1b[1m\n\\x09\\x7f\\xc2\\x9b\\xff");
    EXPECT_EQ(printable(text, Escaped::not_utf8), "\x1b[1m\n\t\x7f\xc2\x9b\\xff");
}

TEST(PrintableText, DocumentsHoldNoOtherBytes) {
    Json::Value json;
    json["a\xff"] = "b\xfe\n";
    EXPECT_EQ(json_line(json), "{\"a\\\\xff\": \"b\\\\xfe\\n\"}");
    EXPECT_EQ(xml_text("<\xff>"), "&lt;\\xff&gt;");
}

}  // namespace
}  // namespace drape

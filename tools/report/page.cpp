#include "report/page.h"

#include <fmt/format.h>

#include "output/xml_text.h"

namespace drape::report {

namespace {

constexpr const char* style = R"css(
body { font: 15px/1.45 system-ui, sans-serif; margin: 0; color: #1c1e21; background: #f4f5f7; }
main { max-width: 1240px; margin: 0 auto; padding: 1.2rem; }
section { background: #fff; border: 1px solid #dfe2e6; border-radius: 8px; padding: .8rem 1.1rem; margin: 0 0 1rem; }
h1 { font-size: 1.5rem; margin: .2rem 0 .8rem; } h2 { font-size: 1.1rem; margin: .2rem 0 .6rem; }
.runs { display: grid; grid-template-columns: repeat(auto-fit, minmax(400px, 1fr)); gap: 1rem; }
.plots { display: grid; grid-template-columns: repeat(auto-fit, minmax(430px, 1fr)); gap: .6rem; }
.sheet { display: grid; grid-template-columns: repeat(4, 1fr); gap: 4px; }
.sheet .between { display: none; } .player { max-width: 760px; }
.sheet figure { margin: 0; } .sheet img, .player img { width: 100%; display: block; border-radius: 3px; }
figcaption { font-size: .75rem; color: #5a6068; } svg { width: 100%; height: auto; }
.wide { overflow-x: auto; } table { border-collapse: collapse; } td, th { text-align: left; padding: .15rem .9rem .15rem 0; vertical-align: top; }
td.number { text-align: right; font-variant-numeric: tabular-nums; } th { font-weight: 600; }
.player input { width: 55%; vertical-align: middle; } .good { color: #08703f; } .bad { color: #b3261e; font-weight: 600; }
.space { max-width: 760px; } .stage canvas { width: 100%; height: auto; display: block; border-radius: 3px; outline: none; }
.beside { display: grid; grid-template-columns: 3fr 2fr; gap: 1rem; } .beside > div { min-width: 0; }
.space .controls { margin: .4rem 0; } .space .controls input[type=range] { width: 40%; vertical-align: middle; }
.legend { margin: 0; min-height: 1.4em; } .legend i { display: inline-block; width: 9em; height: .8em; }
pre { white-space: pre-wrap; overflow-wrap: anywhere; font-size: .8rem; margin: .2rem 0; }
)css";

}  // namespace

std::string page_of(const std::string& title, const std::string& body, const std::string& scripts) {
    return fmt::format(
        "<!DOCTYPE html>\n<html lang=\"en\">\n<head>\n<meta charset=\"utf-8\"/>\n<title>{0}</title>\n"
        "<meta name=\"viewport\" content=\"width=device-width\"/>\n<style>{1}</style>\n</head>\n<body>\n<main>\n"
        "<h1>{0}</h1>\n{2}</main>\n{3}</body>\n</html>\n",
        xml_text(title), style, body, scripts);
}

}  // namespace drape::report

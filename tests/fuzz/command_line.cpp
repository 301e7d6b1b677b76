// A command line, a word per line, gives a command to run, help, or an error, never two of them.
#include "drape/error.h"
#include "fuzz.h"
#include "program.h"
#include "run/run.h"

extern "C" int DRAPE_FUZZ_ENTRY(command_line)(const std::uint8_t* data, std::size_t size) {
    using namespace drape;
    using fuzz::require;
    std::vector<std::string> words{"drape"};
    std::string_view rest = fuzz::text_of(data, size);
    // No argument holds a zero byte.
    rest = rest.substr(0, rest.find('\0'));
    while (!rest.empty()) {
        const std::size_t end = std::min(rest.find('\n'), rest.size());
        words.emplace_back(rest.substr(0, end));
        rest.remove_prefix(std::min(end + 1, rest.size()));
    }
    cli::Program program(words);
    cli::add_commands(program);
    const cli::Program::Parsed parsed = program.parse();
    const int outcomes = (parsed.command ? 1 : 0) + !parsed.data.empty() + !parsed.message.empty();
    require(outcomes == 1, "not one outcome of a command line");
    require(parsed.message.empty() == (parsed.code == ExitCode::ok), "a complaint that ends as if all were well");
    if (words.size() < 2 || words[1] != "help") return 0;
    try {
        require(!program.help({words.begin() + 2, words.end()}).empty(), "no help");
    } catch (const UsageError& error) {
        require(!std::string(error.what()).empty(), "refused without a reason");
    }
    return 0;
}

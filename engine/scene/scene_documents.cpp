#include <fmt/format.h>

#include "drape/scene_reader.h"
#include "scene/oracle_kinds.h"
#include "scene/scene_value.h"

namespace drape {
namespace {

std::string key_schema(const KeyText& key) {
    // Draft-07 ignores everything else beside a reference.
    const bool refers = key.schema.starts_with("\"$ref\"");
    std::string members = refers ? "\"allOf\": [{" + key.schema + "}]" : key.schema;
    if (!key.default_value.empty()) members += ", \"default\": " + key.default_value;
    return fmt::format("{}: {{{}, \"description\": {}}}", quoted(key.name), members, quoted(key.help));
}

/// Returns the members of an object's schema, each on lines of its own.
std::string object_schema(const Definition& object, const std::string& indent) {
    std::string required, properties;
    for (const KeyText& key : object.keys) {
        if (key.required) required += (required.empty() ? "" : ", ") + quoted(key.name);
        properties += (properties.empty() ? "\n" : ",\n") + indent + "  " + key_schema(key);
    }
    std::string members = indent + "\"type\": \"object\"";
    members += ",\n" + indent + "\"additionalProperties\": ";
    members += object.other_keys.empty() ? "false" : "{" + object.other_keys + "}";
    if (!required.empty()) members += ",\n" + indent + "\"required\": [" + required + "]";
    if (!object.schema.empty()) members += ",\n" + indent + object.schema;
    return members + ",\n" + indent + "\"properties\": {" + properties + "\n" + indent + "}";
}

std::string definition_schema(const Definition& definition) {
    const std::string description = fmt::format("\"description\": {}", quoted(definition.help));
    if (definition.keys.empty())
        return fmt::format("    \"{}\": {{{}, {}}}", definition.name, description, definition.schema);
    return fmt::format("    \"{}\": {{\n      {},\n{}\n    }}", definition.name, description,
                       object_schema(definition, "      "));
}

std::string escaped(std::string_view text) {
    std::string markdown;
    for (const char c : text) {
        if (c == '|' || c == '*' || c == '_' || c == '<') markdown += '\\';
        markdown += c;
    }
    return markdown;
}

/// A paragraph, or with `first` = "- " an item of a list, in lines of at most 120 columns that end outside of code.
std::string filled(const std::string& first, const std::string& text) {
    std::string lines = first, word;
    std::size_t column = first.size();
    bool in_code = false;
    for (const char c : text + ' ') {
        if (c == '`') in_code = !in_code;
        if (c != ' ' || in_code) {
            word += c;
            continue;
        }
        const bool begins = column == first.size();
        if (!begins && column + 1 + word.size() > 120) {
            lines += '\n' + std::string(first.size(), ' ');
            column = first.size();
        } else if (!begins) {
            lines += ' ';
            ++column;
        }
        lines += word;
        column += word.size();
        word.clear();
    }
    return lines + '\n';
}

std::string object_section(const Definition& object) {
    std::string section = fmt::format("\n## {}\n\n{}\n", object.name, filled("", escaped(object.help)));
    for (const KeyText& key : object.keys)
        section += filled("- ", fmt::format("`{}`: {}{}. {}", key.name, key.words,
                                            key.required                ? ", required"
                                            : key.default_value.empty() ? ""
                                                                        : ", default `" + key.default_value + "`",
                                            escaped(key.help)));
    if (!object.other_keys.empty()) section += "- any other key: number. A limit of the check.\n";
    return section;
}

std::string oracle_section() {
    std::string section = "\n## oracles\n\n" +
                          filled("",
                                 "The checks that a scene may name; every limit of a check must be given. "
                                 "`drape verify` judges them.") +
                          '\n';
    for (const OracleKind& kind : oracle_kinds()) {
        std::string limits;
        for (const OracleLimit& limit : kind.limits)
            limits += fmt::format("{}`{}`: {}", limits.empty() ? " Limits: " : "; ", limit.name, escaped(limit.help));
        section +=
            filled("- ", fmt::format("`{}`: {}{}{}", kind.name, escaped(kind.help), limits, limits.empty() ? "" : "."));
    }
    return section;
}

}  // namespace

std::string scene_schema() {
    const std::vector<const Definition*> definitions = scene_definitions();
    const Definition& scene = *definitions.front();
    std::string text = fmt::format(
        "{{\n  \"$schema\": \"http://json-schema.org/draft-07/schema#\",\n  \"$id\": \"urn:drape:scene\",\n  "
        "\"title\": \"Drape scene\",\n"
        "  \"description\": {},\n{},\n  \"definitions\": {{\n",
        quoted(scene.help), object_schema(scene, "  "));
    for (std::size_t i = 1; i < definitions.size(); ++i)
        text += definition_schema(*definitions[i]) + (i + 1 < definitions.size() ? ",\n" : "\n");
    return text + "  }\n}\n";
}

std::string scene_format_markdown() {
    std::string objects, values;
    for (const Definition* definition : scene_definitions()) {
        if (!definition->keys.empty())
            objects += object_section(*definition);
        else
            values += filled(
                "- ", fmt::format("**{}**: {}. {}", definition->name, definition->words, escaped(definition->help)));
    }
    return "# What may stand in a scene file?\n\n" +
           filled("",
                  "A scene file is JSON with // comments. Here are all its objects and their keys, from the table that "
                  "the program reads scenes by. `drape schema` prints the same as a JSON Schema, for editors; "
                  "`drape check SCENE` says what is wrong with a scene.") +
           objects + oracle_section() + "\n## values\n\nSeveral keys have values of these forms.\n\n" + values;
}

}  // namespace drape

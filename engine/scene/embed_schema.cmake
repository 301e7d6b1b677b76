# Writes OUTPUT, a C++ file that returns the text of SCHEMA. Run by engine/scene/CMakeLists.txt.
file(READ ${SCHEMA} text)
file(WRITE ${OUTPUT} "#include \"scene/scene_reader.h\"\n\nnamespace drape {\n\n"
                     "std::string_view scene_schema() {\n    return R\"schema(${text})schema\";\n}\n\n"
                     "}  // namespace drape\n")

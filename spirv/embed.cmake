# Writes OUTPUT, a C++ file with the words of every module of FOLDER whose name the file MODULES lists. Run by
# spirv/CMakeLists.txt.
file(STRINGS ${MODULES} names)
set(code "#include \"spirv_modules.h\"\n\nnamespace drape {\nnamespace {\n")
set(rows "")
list(SORT names)
set(index 0)
foreach(module ${names})
  string(REGEX REPLACE "\\.spv$" "" name ${module})
  file(READ ${FOLDER}/${module} hex HEX)
  string(REGEX REPLACE "(..)(..)(..)(..)" "0x\\4\\3\\2\\1," words "${hex}")
  string(APPEND code "constexpr std::uint32_t module_${index}[] = {${words}};\n")
  string(APPEND rows "    {\"${name}\", module_${index}},\n")
  math(EXPR index "${index} + 1")
endforeach()
string(APPEND code "constexpr SpirvModule table[] = {\n${rows}};\n}  // namespace\n\n"
                   "std::span<const SpirvModule> spirv_modules() { return table; }\n\n}  // namespace drape\n")
file(CONFIGURE OUTPUT ${OUTPUT} CONTENT "${code}" @ONLY)  # keeps its time where nothing changed

# cmake -DOUTPUT=FILE.cpp -DHEADER=… -DNAMESPACE=… "-DFILES=name=path;…" -P embed_text.cmake
# One constant string per file; raw literals are cut into pieces that every compiler takes.
set(text "#include \"${HEADER}\"\n\nnamespace ${NAMESPACE} {\n\n")
foreach(entry IN LISTS FILES)
    string(REGEX MATCH "^([^=]+)=(.*)$" _ "${entry}")
    set(name ${CMAKE_MATCH_1})
    file(READ "${CMAKE_MATCH_2}" hex HEX)
    string(APPEND text "static const unsigned char ${name}Bytes[] = {")
    string(REGEX REPLACE "(..)" "0x\\1," bytes "${hex}")
    string(APPEND text "${bytes}0};\n")
    string(APPEND text
        "const std::string_view ${name}(reinterpret_cast<const char*>(${name}Bytes), sizeof(${name}Bytes) - 1);\n\n")
endforeach()
string(APPEND text "} // namespace ${NAMESPACE}\n")
file(WRITE ${OUTPUT} "${text}")

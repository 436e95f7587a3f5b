# gnomon_layer(<name> [LIGHT] SOURCES <file>... [NEEDS <target>...] [USES <target>...])
# Makes the static library of a layer, from the folder that calls it. Links the layers that its row in src/layers.txt
# lists (`layer_needs`). NEEDS and USES name other libraries; USES are private.
# LIGHT: nothing in the layer runs long; it is optimised less, which compiles faster.
function(gnomon_layer name)
    cmake_parse_arguments(PARSE_ARGV 1 arg "LIGHT" "" "SOURCES;NEEDS;USES")
    add_library(gnomon_${name} STATIC ${arg_SOURCES})
    add_library(gnomon::${name} ALIAS gnomon_${name})
    gnomon_prepare_unity(gnomon_${name})
    target_include_directories(gnomon_${name} PUBLIC ${PROJECT_SOURCE_DIR}/src ${PROJECT_SOURCE_DIR})
    target_link_libraries(gnomon_${name} PUBLIC ${layer_needs} ${arg_NEEDS} PRIVATE gnomon_options ${arg_USES})
    if(arg_LIGHT)
        gnomon_compile_light(gnomon_${name})
        gnomon_reuse_headers(gnomon_${name} gnomon_light_headers)
    else()
        gnomon_reuse_headers(gnomon_${name} gnomon_headers)
    endif()
endfunction()

# Where several files are compiled as one (CMAKE_UNITY_BUILD): files that Highway compiles once for each instruction set
# stay alone, since they include themselves, and generated ones, which clang-tidy does not wait for; and gcc takes a file
# that is included for a header, of whose unnamed namespaces it warns. Other builds and clang-tidy keep that warning.
function(gnomon_prepare_unity target)
    get_target_property(sources ${target} SOURCES)
    foreach(source IN LISTS sources)
        if(source MATCHES "^${PROJECT_BINARY_DIR}/")
            set_source_files_properties(${source} PROPERTIES SKIP_UNITY_BUILD_INCLUSION ON)
        elseif(source MATCHES "\\.cpp$" AND EXISTS ${CMAKE_CURRENT_SOURCE_DIR}/${source})
            file(STRINGS ${source} many_targets REGEX "foreach_target\\.h")
            if(many_targets)
                set_source_files_properties(${source} PROPERTIES SKIP_UNITY_BUILD_INCLUSION ON)
            endif()
        endif()
    endforeach()
    if(CMAKE_CXX_COMPILER_ID STREQUAL "GNU" AND CMAKE_UNITY_BUILD)
        target_compile_options(${target} PRIVATE -Wno-subobject-linkage)
    endif()
endfunction()

function(gnomon_compile_light target)
    target_compile_options(${target} PRIVATE $<$<CONFIG:Release>:-O1>)
endfunction()

# Compiles a target with the headers that `from` has parsed. gcc 12 then no longer knows which of them are the system's,
# and warns of copies past the end of small strings that do not happen (its bug 105651); builds without precompiled
# headers, those of clang and the sanitizers, keep these warnings.
function(gnomon_reuse_headers target from)
    target_precompile_headers(${target} REUSE_FROM ${from})
    if(CMAKE_CXX_COMPILER_ID STREQUAL "GNU" AND NOT CMAKE_DISABLE_PRECOMPILE_HEADERS)
        target_compile_options(${target} PRIVATE
            -Wno-array-bounds -Wno-restrict -Wno-stringop-overflow -Wno-stringop-overread)
    endif()
endfunction()

# What precompiled headers and the tests that take them have to be compiled with alike.
function(gnomon_compile_as_test target)
    target_compile_definitions(${target} PRIVATE GNOMON_SOURCE_DIR="${PROJECT_SOURCE_DIR}")
    # What a test takes long for is in the layers; more than -O1 costs a quarter of the time that tests take to compile.
    target_compile_options(${target} PRIVATE $<$<CONFIG:Release>:-O1>)
endfunction()

# gnomon_tests(<layer> SOURCES <file>... [NEEDS <target>...] [LABELS <label>...])
# One test program per layer; every TEST in it is a ctest entry with the label `unit` and those given. A suite whose name
# starts with "Slow" (behind the prefix of an instantiation) has the label `slow` instead. `scripts/test --all` builds
# the targets address_tests and thread_tests, and runs the entries with these labels, with a sanitizer. A test that takes
# too long there says so (tests/support/sanitizers.h). Entries with the label `after_return` run with the address
# sanitizer as well, and there it also finds the use of a stack after its function has returned.
function(gnomon_tests name)
    cmake_parse_arguments(PARSE_ARGV 1 arg "" "" "SOURCES;NEEDS;LABELS")
    add_executable(${name}_tests ${arg_SOURCES} $<TARGET_OBJECTS:gnomon_test_support>)
    target_include_directories(${name}_tests PRIVATE ${PROJECT_SOURCE_DIR})
    target_link_libraries(${name}_tests PRIVATE ${arg_NEEDS} gnomon_options GTest::gtest_main)
    gnomon_compile_as_test(${name}_tests)
    gnomon_prepare_unity(${name}_tests)
    gnomon_reuse_headers(${name}_tests gnomon_test_support)
    foreach(label IN LISTS arg_LABELS)
        if(TARGET ${label}_tests)
            add_dependencies(${label}_tests ${name}_tests)
        endif()
    endforeach()
    gtest_discover_tests(${name}_tests TEST_FILTER "-Slow*:*/Slow*" TEST_LIST ${name}_quick DISCOVERY_TIMEOUT 60)
    # PROPERTIES of the line above splits a list of labels, so a script that ctest includes after the tests sets them.
    set(script ${CMAKE_CURRENT_BINARY_DIR}/${name}_labels.cmake)
    file(WRITE ${script} "if(${name}_quick)\n    set_tests_properties(\${${name}_quick} PROPERTIES LABELS \"unit;${arg_LABELS}\")\nendif()\n")
    gtest_discover_tests(${name}_tests TEST_FILTER "Slow*:*/Slow*" TEST_LIST ${name}_slow
        PROPERTIES LABELS slow DISCOVERY_TIMEOUT 60)
    set_property(DIRECTORY APPEND PROPERTY TEST_INCLUDE_FILES ${script})
endfunction()

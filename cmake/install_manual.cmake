# Run by `cmake --install` after the program `manual_of` is there: its manual pages, packed, and what shells complete.
cmake_policy(VERSION 3.25)
set(root $ENV{DESTDIR}${CMAKE_INSTALL_PREFIX})
set(share ${root}/share)

function(print_manual words file)
    get_filename_component(folder ${file} DIRECTORY)
    file(MAKE_DIRECTORY ${folder})
    execute_process(COMMAND ${root}/bin/${manual_of} manual ${words} OUTPUT_FILE ${file} COMMAND_ERROR_IS_FATAL ANY)
endfunction()

# A page for the program and one for each of its commands: gnomon-sun-hours is that of `gnomon sun hours`.
function(print_pages)
    foreach(command IN ITEMS "" ${ARGN})
        string(REPLACE " " "-" name "${manual_of} ${command}")
        string(REGEX REPLACE "-$" "" name ${name})
        string(REPLACE " " ";" words "man ${command}")
        list(REMOVE_ITEM words "")
        set(page ${share}/man/man1/${name}.1)
        print_manual("${words}" ${page})
        execute_process(COMMAND gzip -9nf ${page} COMMAND_ERROR_IS_FATAL ANY)
    endforeach()
endfunction()

if(manual_of STREQUAL gnomon-mpi)
    print_pages(build sun "sun hours")
else()
    print_pages(make build info verify export path render measure explain bench "bench build" view
        sun "sun position" "sun hours" theory "theory eval" "theory figures" "theory table")
    print_manual(bash ${share}/bash-completion/completions/gnomon)
    print_manual(zsh ${share}/zsh/vendor-completions/_gnomon)
    print_manual(fish ${share}/fish/vendor_completions.d/gnomon.fish)
endif()

gnomon_tests(make
    SOURCES
        ${CMAKE_CURRENT_LIST_DIR}/made_mesh.cpp
        ${CMAKE_CURRENT_LIST_DIR}/make_file_test.cpp
        ${CMAKE_CURRENT_LIST_DIR}/make_planes_test.cpp
        ${CMAKE_CURRENT_LIST_DIR}/make_plant_test.cpp
        ${CMAKE_CURRENT_LIST_DIR}/make_statue_test.cpp
    NEEDS gnomon::make
    LABEL threads)

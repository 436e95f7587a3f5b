gnomon_tests(build
    SOURCES build_model_test.cpp build_fan_map_test.cpp build_simplify_test.cpp build_meshes.cpp
    NEEDS gnomon::build
    LABEL threads)

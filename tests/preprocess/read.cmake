gnomon_tests(read
    SOURCES read_models_test.cpp read_ply_test.cpp read_polygon_test.cpp read_whole_file_test.cpp
    NEEDS gnomon::read)

gnomon_tests(read
    SOURCES read_models_test.cpp
    NEEDS gnomon::read)

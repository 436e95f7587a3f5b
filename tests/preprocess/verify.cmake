gnomon_tests(verify
    SOURCES
        ${CMAKE_CURRENT_LIST_DIR}/export_test.cpp
        ${CMAKE_CURRENT_LIST_DIR}/hard_cases_test.cpp
        ${CMAKE_CURRENT_LIST_DIR}/triangle_tree_test.cpp
        ${CMAKE_CURRENT_LIST_DIR}/verify_test.cpp
    NEEDS gnomon::pipeline gnomon::verify gnomon::export gnomon_tiny_model
    LABEL threads)

find_package(hwy REQUIRED)
gnomon_tests(build
    SOURCES build_cost_test.cpp build_fan_map_test.cpp build_kd_split_test.cpp build_living_patch_test.cpp
            build_local_numbers_test.cpp build_meshes.cpp build_model_test.cpp build_nearest_test.cpp
            build_normals_test.cpp build_point_tree_test.cpp build_queue_test.cpp build_simplify_test.cpp
    NEEDS gnomon::pipeline hwy::hwy
    LABEL threads)
gnomon_tests(pipeline
    SOURCES chunk_test.cpp pipeline_test.cpp build_meshes.cpp
    NEEDS gnomon::pipeline
    LABEL threads)

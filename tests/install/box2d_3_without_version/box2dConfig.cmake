# Stands for a package of Box2D 3.x that does not say its number: the headers do.
add_library(box2d::box2d INTERFACE IMPORTED)
target_include_directories(box2d::box2d INTERFACE "${CMAKE_CURRENT_LIST_DIR}/include")

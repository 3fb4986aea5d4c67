# Stands for the package of Box2D 3.1. Its number is enough to refuse it.
message(FATAL_ERROR "the package of another version was read")

// Stands for the one header of Box2D 3.x: there is no box2d/b2_world.h.

// Nothing: the code is in the library of the system.

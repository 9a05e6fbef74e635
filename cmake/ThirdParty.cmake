# Imported targets for everything that is not ours. Each is linked PRIVATE to the one module that may
# include it (tests/lint/check_layers.py), so nothing but MPI reaches a user's compile line. All modules
# have fmt for their messages, in no public header.
include(cmake/LinkedLibraries.cmake)

# These serve to compile libtessera, or belong to the program.
find_package(toml11 REQUIRED)
find_package(CLI11 REQUIRED)
find_package(nlohmann_json REQUIRED)

# Writes the stubs FROM to TO without the "| None" of arguments that must not be None. nanobind writes "| None" for
# every argument, because all of them are bound so that they accept None (arguments.h, given()). An argument may be None
# only if None is its default, or if its own type says so and "| None" therefore occurs twice.
file(READ "${FROM}" text)
string(REPLACE " | None | None = None" " | None = None" text "${text}")
string(REPLACE " | None = None" " ?= None" text "${text}")
string(REGEX REPLACE " \\| None([,)]| =)" "\\1" text "${text}")
string(REPLACE " ?= None" " | None = None" text "${text}")
file(WRITE "${TO}" "${text}")

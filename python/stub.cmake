# FROM to TO: stubs that say which arguments may be None. nanobind writes that of every argument, for each is bound as one
# that takes None, so that refusing it names the argument (arguments.h). It is true where None is the default, or where
# the argument's own type says so and it stands twice.
file(READ "${FROM}" text)
string(REPLACE " | None | None = None" " | None = None" text "${text}")
string(REPLACE " | None = None" " ?= None" text "${text}")
string(REGEX REPLACE " \\| None([,)]| =)" "\\1" text "${text}")
string(REPLACE " ?= None" " | None = None" text "${text}")
file(WRITE "${TO}" "${text}")

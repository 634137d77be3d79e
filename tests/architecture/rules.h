// The rules of the house. Each looks at a tree of files and names what breaks it, as "path:line: what".
#pragma once

#include <string>
#include <vector>

#include "architecture/floors.h"
#include "architecture/source_tree.h"

namespace limn::architecture {

using Violations = std::vector<std::string>;

/// Every include from one room to another is an arrow of the table.
Violations check_floors(const SourceTree& tree, const Floors& floors);

/// Quoted includes name files that exist: public headers know public headers alone, lib also its own private ones;
/// apps and examples never know a private header of lib.
Violations check_quoted_includes(const SourceTree& tree);

/// Public headers include std alone and name no type of another library; in lib each library stays in its rooms.
Violations check_libraries(const SourceTree& tree);

/// limn/limn.h includes every public header.
Violations check_umbrella(const SourceTree& tree);

/// No class of include/limn and lib has more than four virtual functions besides its destructor.
Violations check_virtuals(const SourceTree& tree);

/// lib/flat has no virtual function and no pointer to a described object.
Violations check_flat(const SourceTree& tree);

/// In include/limn and lib no pointer to a coordinate or other member is taken in order to reach the next one, and no
/// object is read through a pointer to another type but as bytes: compilers make use of both being undefined.
Violations check_pointers(const SourceTree& tree);

/// Nothing that renders asks for the date, of its clock or of a file: it may go back. What takes time is told by
/// std::chrono::steady_clock.
Violations check_clocks(const SourceTree& tree);

/// What enters a picture calls no sine, exponential or the like of the C library: their last bits differ between
/// processors and versions. Only what is told of finished pictures does.
Violations check_elementary(const SourceTree& tree);

/// Files can be read in one sitting: 400 lines; 80 in cmake/, 25 and 60 for the examples, 60 of code for a figure.
Violations check_lengths(const SourceTree& tree);

}  // namespace limn::architecture

"""The rules of the house. Each looks at a tree of files and yields what breaks it, as "path:line: what"."""

import re

from house import folder_of, room_of


def at(file, line, what):
    return f"{file.path}:{line}: {what}"


def find_all(file, pattern, what):
    """Every place in the code that a pattern matches; a group `allowed` that matched excuses it."""
    for match in re.finditer(pattern, file.code):
        if not match.groupdict().get("allowed"):
            yield at(file, 1 + file.code.count("\n", 0, match.start()), f"{what}: {match['found']}")


def of_lib(tree):
    return [file for file in tree if file.is_public or file.is_lib]


def paths_of(tree):
    return {file.path for file in tree}


# Of each library: the path that it is included by, what names it in code, and the files that may use it.
LIBRARIES = {
    "OpenImageIO": (r"OpenImageIO/.*", r"\b(OIIO|OpenImageIO)\b", r"lib/io/.*\.cpp"),
    "stb": (r"(stb/)?stb_.*", r"\bstbiw?_\w+", r"lib/io/.*\.cpp"),
    "tinyobjloader": (r"tiny_obj_.*", r"\btinyobj\b", r"lib/io/.*\.cpp"),
    "oneTBB": (r"(tbb|oneapi)/.*", r"\bnamespace\s+tbb\b|\b(tbb|oneapi)\s*::", r"lib/(math/parallel\.h|render/.*)"),
    "Random123": (r"Random123/.*", r"\br123\b", r"lib/render/.*"),
    "xxHash": (r"xxhash\.h", r"\bXXH\w+", r"lib/math/system/checksum\.cpp"),
    "Highway": (r"hwy/.*", r"\bhwy\b",
                r"lib/((bsdf|geometry|math|scene|shading|trace)/.*|query/normals\.cpp)"),
    "fmt": (r"fmt/.*", r"\bfmt\s*::", r"apps/.*"),
    "CLI11": (r"CLI/.*", r"\bCLI\s*::", r"apps/.*"),
    "nlohmann-json": (r"nlohmann/.*", r"\bnlohmann\b", r"lib/io/gltf.*"),
}


def is_of_library(include):
    return any(re.fullmatch(path, include.path) for path, _, _ in LIBRARIES.values())


def is_std_or_posix(file, include):
    """std headers have neither a dot nor a slash; writing files safely and huge pages need POSIX."""
    return bool(re.fullmatch(r"[a-z0-9_]+", include.path)
                or re.fullmatch(r"(unistd|fcntl|sys/\w+)\.h", include.path)
                and re.fullmatch(r"lib/(math/system/(file_lock|huge_pages|replace_file)|io/image_checks)\.cpp", file.path))


def check_floors(tree, floors):
    """Every include from one room to another is an arrow of the table, and every arrow is used."""
    paths, used = paths_of(tree), set()
    for file in tree:
        room = room_of(file.path)
        if not room:
            continue
        if room not in floors.arrows:
            yield at(file, 1, f"the floors do not know the room {room}")
            continue
        for include in file.includes:
            target = ("include/" if include.path.startswith("limn/") else "lib/") + include.path
            if target not in paths:
                continue
            other = room_of(target)
            used.add((room, other))
            if not other:
                yield at(file, include.line, "a room includes the umbrella")
            elif room != other and other not in floors.arrows[room]:
                yield at(file, include.line, f"{room} -> {other} is no arrow of the floors")
    for room, below in floors.arrows.items():
        yield from (f"floors.txt: no file of {room} includes one of {other}" for other in below
                    if (room, other) not in used)


# The classes of higher floors that a room may declare, to hold pointers to them. The room never looks inside.
DECLARED_FROM_BELOW = {"math": {"Material", "MaterialThunks", "RayFrame"},
                       "records": {"AlbedoTable", "Hittable", "Lobe", "Texture"}}


def check_forward_declarations(tree, floors):
    """A room declares classes of its own and of rooms that it may include. DECLARED_FROM_BELOW lists the exceptions;
    each of them is used. Indented declarations are of nested classes, which the room defines itself."""
    rooms_of, used = {}, set()
    for file in of_lib(tree):
        for match in re.finditer(r"\b(?:class|struct)\s+(\w+)\s*(?:final\s*)?(?::[^;{]*)?\{", file.code):
            rooms_of.setdefault(match[1], set()).add(room_of(file.path))
    for file in of_lib(tree):
        room = room_of(file.path)
        allowed = {room, *floors.arrows.get(room, [])}
        for match in re.finditer(r"(?m)^(?:class|struct)\s+(\w+)\s*;", file.code):
            if not rooms_of.get(match[1]) or allowed & rooms_of[match[1]]:
                continue
            if match[1] in DECLARED_FROM_BELOW.get(room, ()):
                used.add((room, match[1]))
                continue
            line = 1 + file.code.count("\n", 0, match.start(1))
            yield at(file, line, f"{room} declares {match[1]} of {' '.join(sorted(rooms_of[match[1]]))}")
    for room, names in DECLARED_FROM_BELOW.items():
        yield from (f"DECLARED_FROM_BELOW: {room} does not declare {name} of a higher floor" for name in sorted(names)
                    if (room, name) not in used)


# In the room of the description each folder may include those after it.
DESCRIPTION = ["scene", "scene/shape", "scene/material", "scene/texture"]


def check_description(tree):
    """Textures know no material, materials no shape, and shapes no scene."""
    for file in tree:
        folder = folder_of(file.path)
        if folder not in DESCRIPTION:
            continue
        for include in file.includes:
            other = folder_of("lib/" + include.path.removeprefix("limn/"))
            if other in DESCRIPTION[:DESCRIPTION.index(folder)]:
                yield at(file, include.line, f"{folder} includes {other}")


def check_quoted_includes(tree):
    """Quoted includes name files that exist: public headers know public headers alone, lib also its own private ones;
    apps and examples know no private header of lib, but for the codec that limn's programs bring."""
    paths = paths_of(tree)
    for file in tree:
        if not (file.is_public or file.is_lib or file.is_program):
            continue
        for include in file.includes:
            is_face, is_private = include.path.startswith("limn/"), f"lib/{include.path}" in paths
            if include.path == "io/image_codec.h" and re.fullmatch(r"apps/common/image_(loader|module)\.cpp", file.path):
                continue
            if include.angle and not is_face:
                continue
            if "../" in include.path:
                yield at(file, include.line, f"{include.path} climbs out of its folder")
            elif is_face and f"include/{include.path}" not in paths:
                yield at(file, include.line, f"there is no public header {include.path}")
            elif not is_face and is_private and not file.is_lib:
                yield at(file, include.line, f"{include.path} is private to lib")
            elif not is_face and not is_private and not file.is_program and not is_of_library(include):
                yield at(file, include.line, f"there is no header {include.path}")


def check_libraries(tree):
    """Public headers include std alone and name no type of another library; in lib each library stays in its rooms."""
    for file in of_lib(tree):
        for name, (path, word, home) in LIBRARIES.items():
            if re.fullmatch(home, file.path):
                continue
            yield from find_all(file, f"(?P<found>{word})", f"{name} does not belong here")
            for include in file.includes:
                if re.fullmatch(path, include.path):
                    yield at(file, include.line, f"{name} does not belong here: {include.path}")
        for include in file.includes:
            if include.angle and not is_of_library(include) and not is_std_or_posix(file, include):
                yield at(file, include.line, f"not a header of std: {include.path}")


def check_umbrella(tree):
    """limn/limn.h includes every public header."""
    umbrella = next((file for file in tree if file.path == "include/limn/limn.h"), None)
    if umbrella is None:
        yield "include/limn/limn.h: missing"
        return
    included = {include.path for include in umbrella.includes}
    for file in tree:
        path = file.path.removeprefix("include/")
        if file.is_public and file is not umbrella and path not in included:
            yield at(umbrella, 1, f"does not include {path}")


def check_once(tree):
    """Including a public header again is harmless."""
    for file in tree:
        if file.is_public and "\n#pragma once\n" not in "\n" + file.code:
            yield at(file, 1, "no #pragma once")


def check_virtuals(tree):
    """No class of include/limn and lib has more than four virtual functions besides its destructor."""
    for file in of_lib(tree):
        for head in re.finditer(r"\b(?:class|struct)\s+(\w+)(?:\s+final)?\s*(?::[^;{]*)?\{", file.code):
            depth, end = 1, head.end()
            while end < len(file.code) and depth > 0:
                depth += {"{": 1, "}": -1}.get(file.code[end], 0)
                end += 1
            count = len(re.findall(r"\bvirtual\b(?!\s*~)", file.code[head.end():end]))
            if count > 4:
                line = 1 + file.code.count("\n", 0, head.start())
                yield at(file, line, f"{head[1]} has {count} virtual functions")


def check_flat(tree):
    """The tables of lib/flat have no virtual function and no pointer to a described object."""
    kinds = r"(Hittable|Material|Texture)\b"
    for file in tree:
        if re.fullmatch(r"lib/flat/(environment|light_table|lights|list|scene|tree)\.h", file.path):
            yield from find_all(file, r"(?P<found>\bvirtual\b)", "dispatch in the flat scene")
            yield from find_all(file, rf"(?P<found>\b{kinds}(\s*const\b)?\s*[*&]|_ptr\s*<\s*(const\s+)?(limn::)?{kinds})",
                                "a described object in the flat scene")


def check_pointers(tree):
    """In include/limn and lib no pointer to a coordinate or other member is taken in order to reach the next one, and no
    object is read through a pointer to another type but as bytes: compilers make use of both being undefined."""
    # `a & b.x` has spaces. Highway gathers from a pointer to the kind of number that lies there, among others.
    for file in of_lib(tree):
        yield from find_all(file, r"(?P<found>&[A-Za-z_]\w*((\.|->)\w+|\[\w*\])*(\.|->)[xyzrgbuv]\b)",
                            "no pointer to one coordinate reaches another")
        yield from find_all(file, r"(?P<found>\(&\w+((\.|->|\[)[\w\]]+)+\)\s*\[)", "no pointer to a member reaches another")
        yield from find_all(file, r"(?P<allowed>\bGatherIndex\((?:[^();]|\(\))*)?(?P<found>\breinterpret_cast\s*<(?!\s*"
                                  r"(const\s+)?(char|unsigned char|std::byte|std::u?int8_t|std::u?intptr_t)\b)[^>]*>)",
                            "objects are read as what they are, or as bytes")


def check_lobes(tree):
    """The materials that tests/render compares have every lobe."""
    examples = "".join(file.code for file in tree if file.path == "tests/render/lobe_examples.h")
    for file in tree:
        if file.path.startswith("lib/scene/material/") and "LIMN_LOBE(" in file.code:
            name = re.search(r"\bMaterialRecord (\w+)::lower\b", file.code)[1]
            if f"<{name}>(" not in examples:
                yield at(file, 1, f"{name} is not in tests/render/lobe_examples.h")


def check_clocks(tree):
    """Nothing that renders asks for the date, of its clock or of a file: it may go back. What takes time is told by
    std::chrono::steady_clock."""
    date = (r"(?P<found>\b(system_clock|high_resolution_clock|file_clock|utc_clock|last_write_time|CLOCK_REALTIME|"
            r"gettimeofday|localtime|gmtime|mktime|st_[acm]time?|std::time|time\(nullptr\)|time\(0\)))")
    for file in tree:
        if file.is_public or file.is_lib or file.path.startswith(("apps/common/", "apps/limn/")):
            yield from find_all(file, date, "a date can go back")


def check_elementary(tree):
    """What enters a picture calls no sine, exponential or the like of the C library: their last bits differ between
    processors and versions. Only what is told of finished pictures does."""
    function = r"(?P<found>\bstd::(a?(sin|cos|tan)h?|atan2|exp2?|expm1|log2?|log10|log1p|pow|cbrt)\b(?!::))"
    for file in of_lib(tree):
        if not re.fullmatch(r"lib/image/(compare|encode|error_image)\.cpp", file.path):
            yield from find_all(file, function, "math/elementary.h has the same bits everywhere")


def check_lengths(tree):
    """Files can be read in one sitting: 400 lines; 80 in cmake/, 25 and 60 for the examples, 60 of code for a figure."""
    for file in tree:
        lines, limit = file.lines, 400
        if re.fullmatch(r"examples/figures/fig\d\d_\w+\.cpp", file.path):
            lines, limit = len(re.findall(r"(?m)^[ \t]*[^#\s]", file.code)), 60
        elif re.fullmatch(r"examples/custom_\w+\.cpp", file.path):
            limit = 60
        elif file.path == "examples/minimal.cpp":
            limit = 25
        elif file.path.startswith("cmake/"):
            limit = 80
        if lines > limit:
            yield at(file, lines, f"{lines} lines, more than {limit}")

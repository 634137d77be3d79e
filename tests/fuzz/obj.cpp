// Whatever the text of an OBJ and its MTL is, load_obj gives a model or a FileError. A zero byte divides the two.
#include <algorithm>
#include <cstdint>

#include "limn/io/obj.h"
#include "limn/math/error.h"
#include "scratch_file.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    static const std::string obj_path = limn::fuzz::scratch_path("a.obj"), mtl_path = limn::fuzz::scratch_path("a.mtl");
    const std::string_view input(reinterpret_cast<const char*>(data), size);
    const std::size_t end = std::min(input.find('\0'), input.size());
    limn::fuzz::write_file(obj_path, std::string(input.substr(0, end)) + "\nmtllib a.mtl\n");
    limn::fuzz::write_file(mtl_path, input.substr(std::min(end + 1, input.size())));
    limn::fuzz::attempt<limn::FileError>([&] { limn::load_obj(obj_path); });
    return 0;
}

// Whatever the bytes of rays are, as text and as numbers, reading them gives rays or a FileError, and ends.
#include <cstdint>

#include "limn/math/error.h"
#include "ray_reader.h"
#include "scratch_file.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    static const std::string path = limn::fuzz::scratch_path("rays");
    limn::fuzz::write_file(path, {reinterpret_cast<const char*>(data), size});
    for (const bool binary : {false, true})
        limn::fuzz::attempt<limn::FileError>([&] {
            limn::app::RayReader reader(path, binary);
            while (!reader.next().empty()) {}
        });
    return 0;
}

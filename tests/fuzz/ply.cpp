// Whatever the bytes of a PLY are, reading them gives a model or a refusal.
#include <cstdint>

#include "io/bytes.h"
#include "io/model_reader.h"
#include "limn/math/error.h"
#include "scratch_file.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    const std::string_view bytes(reinterpret_cast<const char*>(data), size);
    limn::fuzz::attempt<limn::FileError>(
        [&] { limn::fuzz::attempt<limn::Fault>([&] { limn::read_ply(bytes, "a.ply", {.crease = 30}); }); });
    return 0;
}

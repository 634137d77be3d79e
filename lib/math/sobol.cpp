#include "math/sobol.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "math/sobol.cpp"
#include <hwy/foreach_target.h>

#include "math/sobol-inl.h"

HWY_BEFORE_NAMESPACE();
namespace limn::sobol::HWY_NAMESPACE {

// Does the work of draw() for n dimensions.
template <std::size_t n>
HWY_INLINE void draw_first(const Points& points, sampling::Row* numbers) {
    const hn::Rebind<std::uint32_t, Doubles::Tag> words;
    const hn::Rebind<std::uint64_t, Doubles::Tag> long_words;
    for (std::size_t i = 0; i < points.count; i += kLanes<Doubles>)
        draw_numbers<n>(LongWord(hn::LoadU(long_words, points.base + i)), Word(hn::LoadU(words, points.index + i)),
                        Word(hn::LoadU(words, points.group + i)),
                        [&](std::size_t d, Doubles x) HWY_ATTR { store(x, numbers[d] + i); });
}

void draw(const Points& points, std::size_t dimensions, sampling::Row* numbers) {
    switch (dimensions) {
        case 1: return draw_first<1>(points, numbers);
        case 2: return draw_first<2>(points, numbers);
        case 3: return draw_first<3>(points, numbers);
        default: return draw_first<5>(points, numbers);
    }
}

}  // namespace limn::sobol::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace limn::sobol {

HWY_EXPORT(draw);

void draw(const Points& points, std::size_t dimensions, sampling::Row* numbers) {
    HWY_DYNAMIC_DISPATCH(draw)(points, dimensions, numbers);
}

std::uint64_t base_of(std::uint64_t seed, std::uint64_t pixel, std::uint64_t sequence) {
    using namespace HWY_NAMESPACE;
    return seeds_of(seeds_of(mixed(seed + kStep), pixel), sequence);
}

std::uint32_t index_of(std::uint32_t point) { return HWY_NAMESPACE::reversed(point) & ~0xffU; }

std::array<double, kDimensions> numbers_of(std::uint64_t base, std::uint32_t index, std::uint32_t group) {
    std::array<double, kDimensions> numbers;
    HWY_NAMESPACE::draw_numbers<kDimensions>(base, index, group, [&](std::size_t d, double x) { numbers[d] = x; });
    return numbers;
}

}  // namespace limn::sobol
#endif

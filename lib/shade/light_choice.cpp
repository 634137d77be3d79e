#include "shade/light_choice.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "shade/light_choice.cpp"
#include <hwy/foreach_target.h>

#include <cstddef>

#include "shade/doubles-inl.h"

HWY_BEFORE_NAMESPACE();
namespace limn::shade::HWY_NAMESPACE {

using Floats = hn::Rebind<float, Doubles::Tag>;
using Indices = hn::Rebind<std::int32_t, Doubles::Tag>;

// Nodes by lane, as numbers of four bytes one after the other.
class Nodes {
public:
    static constexpr std::size_t kWords = sizeof(flat::LightNode) / 4;

    HWY_INLINE Nodes(const flat::LightTable& lights, Doubles nodes)
        : base_(lights.nodes.data()),
          at_(hn::Mul(hn::DemoteTo(Indices(), nodes.v), hn::Set(Indices(), static_cast<int>(kWords)))) {}

    HWY_INLINE Doubles number(std::size_t offset) const {
        return hn::PromoteTo(Doubles::Tag(),
                             hn::GatherIndex(Floats(), reinterpret_cast<const float*>(base_) + offset / 4, at_));
    }
    HWY_INLINE Vector<Doubles> three(std::size_t offset) const {
        return {number(offset), number(offset + 4), number(offset + 8)};
    }
    HWY_INLINE Doubles index(std::size_t offset) const {
        return hn::PromoteTo(
            Doubles::Tag(), hn::GatherIndex(Indices(), reinterpret_cast<const std::int32_t*>(base_) + offset / 4, at_));
    }

private:
    const flat::LightNode* base_;
    hn::Vec<Indices> at_;
};

struct Receivers {
    Vector<Doubles> position, normal;
    Mask<Doubles> everywhere;  // light counts from all sides
};

struct Importances {
    Doubles value;
    Mask<Doubles> alike;
};

HWY_INLINE Doubles at_most_one(Doubles x) { return select(x < 1.0, x, 1.0); }

// importance_of in render/light_choice.cpp.
HWY_INLINE Importances importance_of(const Nodes& node, const Receivers& receiver) {
    const Doubles zero = 0.0, one = 1.0;
    const Vector<Doubles> way = node.three(offsetof(flat::LightNode, center)) - receiver.position;
    const Vector<Doubles> half = node.three(offsetof(flat::LightNode, half));
    const Doubles strength = node.number(offsetof(flat::LightNode, strength));
    const Doubles spread = node.number(offsetof(flat::LightNode, cos_spread));
    const Doubles d2 = length_squared(way), r2 = length_squared(half);
    const auto gap = [&](Doubles along, Doubles side) HWY_ATTR { return max(zero, abs(along) - side); };
    const Doubles gap_x = gap(way.x, half.x), gap_y = gap(way.y, half.y), gap_z = gap(way.z, half.z);
    const Doubles over_gap = one / sqrt(gap_x * gap_x + gap_y * gap_y + gap_z * gap_z);
    Importances i;
    i.value = strength / max(max(d2, r2), 1e-300);
    i.alike = (kAlikeSquared * r2 <= d2) & ((spread >= kAlikeSpread) | (spread == (flat::kNoNormals)));
    const Mask<Doubles> planes = spread > zero;
    if (any(planes)) {
        const Vector<Doubles> axis = node.three(offsetof(flat::LightNode, axis));
        const Doubles height = abs(dot(axis, way)) + dot(abs(axis), half);
        const Doubles cosine = at_most_one(height * over_gap);
        const Doubles turned = cosine * spread + sqrt((one - cosine * cosine) * (one - spread * spread));
        const Doubles scaled = i.value * select(spread == one, cosine, turned);
        i.value = select(planes & (cosine < spread), scaled, i.value);
    }
    const Doubles middle = dot(receiver.normal, way), height = middle + dot(abs(receiver.normal), half);
    const Mask<Doubles> behind = height <= zero;
    const Doubles before = select(behind, zero, i.value * at_most_one(height * over_gap));
    i.value = select(receiver.everywhere, i.value, before);
    i.alike = select(receiver.everywhere, i.alike, behind | (i.alike & (middle >= zero)));
    // Beyond the range of float.
    const Mask<Doubles> finite = d2 + r2 < kInfinity;
    return {select(finite, i.value, strength), (finite & i.alike)};
}

void descend_lights(const flat::LightTable& lights, Lobe lobe, const VertexLanes& vertices, LightWays& ways) {
    const Doubles zero = 0.0, one = 1.0;
    const hn::Rebind<std::uint32_t, Doubles::Tag> words;
    for (std::size_t i = 0; i < vertices.count; i += kLanes<Doubles>) {
        Receivers receiver{load3(vertices.position, i), load3(vertices.normal, i), (zero == zero)};
        if (lobe == Lobe::lambertian) {
            const Vector<Doubles>& n = receiver.normal;
            receiver.everywhere = ((n.x == zero) & (n.y == zero)) & (n.z == zero);
        }
        Doubles node = zero, begin = zero, probability = one, pick = load<Doubles>(vertices.numbers[0] + i);
        Importances here = importance_of(Nodes(lights, node), receiver);
        probability = select(here.value == zero, zero, probability);
        for (;;) {
            const Nodes at(lights, node);
            const Doubles right = at.index(offsetof(flat::LightNode, right));
            const Mask<Doubles> goes = (!here.alike) & ((probability > zero) & (right > zero));
            if (!any(goes)) break;
            const Doubles left = select(goes, node + one, node);
            const Nodes at_left(lights, left);
            const Importances a = importance_of(at_left, receiver);
            const Importances b = importance_of(Nodes(lights, select(goes, right, node)), receiver);
            const Doubles sum = a.value + b.value, share = a.value / sum;
            const Mask<Doubles> lost = (!(sum > zero)) & goes, to_left = pick < share;
            const Doubles rest = select(to_left, pick / share, (pick - share) / (one - share));
            const Doubles chance = probability * select(to_left, share, one - share);
            probability = select(goes, select(lost, zero, chance), probability);
            pick = select(goes, select(kLargestPick < rest, kLargestPick, rest), pick);
            begin = select((!to_left) & goes, at_left.index(offsetof(flat::LightNode, end)), begin);
            node = select(goes, select(to_left, left, right), node);
            here.alike = select(goes, select(to_left, a.alike, b.alike), here.alike);
        }
        store(probability, ways.probability + i);
        store(pick, ways.pick + i);
        hn::StoreU(hn::BitCast(words, hn::DemoteTo(Indices(), node.v)), words, ways.node + i);
        hn::StoreU(hn::BitCast(words, hn::DemoteTo(Indices(), begin.v)), words, ways.begin + i);
    }
}

}  // namespace limn::shade::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace limn::shade {

HWY_EXPORT(descend_lights);

void descend_lights(const flat::LightTable& lights, Lobe lobe, const VertexLanes& vertices, LightWays& ways) {
    HWY_DYNAMIC_DISPATCH(descend_lights)(lights, lobe, vertices, ways);
}

}  // namespace limn::shade
#endif

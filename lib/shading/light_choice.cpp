// The importance of a node and the descent by it after Conty Estevez and Kulla, Importance Sampling of Many Lights with
// Adaptive Tree Splitting, Proc. ACM Comput. Graph. Interact. Tech. 1(2), 2018. Ours: cosines are bounded by the box in
// place of a ball around it, so that lights close to a plane do not seem to shine along it, and the descent ends where
// all lights below are as good as alike.
#include "shading/light_choice.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "shading/light_choice.cpp"
#include <hwy/foreach_target.h>

#include <algorithm>
#include <cstddef>

#include "math/rows-inl.h"

#ifndef LIMN_LIGHTS_DESCENTS
#define LIMN_LIGHTS_DESCENTS
namespace limn::lights {

// Where each descent ended, at lights that are as good as alike.
struct Descents {
    std::uint32_t node[kShaded] = {}, begin[kShaded] = {};  // whose lights' ranks begin here
    Row probability = {};                                   // of having come there; 0: no light on the receiver's side
    Row pick = {};                                          // what is left of the number, as good as a new one
};

// Of distant lights for each receiver.
struct DistantChoices {
    Row share = {};        // with which probability one of them is chosen at all
    Row rank = {};         // which one then
    Row probability = {};  // of it, the share included
    Row pick = {};         // for the others: what is left of the number, as good as a new one
};

}  // namespace limn::lights
#endif

HWY_BEFORE_NAMESPACE();
namespace limn::lights::HWY_NAMESPACE {

using namespace limn::HWY_NAMESPACE;

using Floats = hn::Rebind<float, Doubles::Tag>;
using Indices = hn::Rebind<std::int32_t, Doubles::Tag>;

// Which lights a node stands for as one, so that the descent need not go on: it is farther than this many half
// diagonals, the lights' normals have at least this cosine with a common axis (or they are spheres) and its middle is
// before the receiver. Measured in the Cornell box: with 1e4 triangles as its lamp 2 takes a third less time per error
// than going down to the leaves, with 200 balls a twentieth; 1.5 to 5 are within 6 % of it.
constexpr double kAlikeSquared = 2.0 * 2.0, kAlikeSpread = 0.9;
// Where there are lights in the tree and distant ones, either kind is chosen with this probability at least, because a
// wall may hide the other. Where one kind brings all the light, and is expected to, that costs a quarter more samples.
constexpr double kLeastShare = 0.2;
// A number that was less than 1 stays so.
constexpr double kLargestPick = 1 - 0x1p-53;

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

struct Receiver {
    Vector<Doubles> position, normal;
    Mask<Doubles> everywhere;  // light counts from all sides

    HWY_INLINE Receiver(const Receivers& receivers, std::size_t i)
        : position(load3<Doubles>(receivers.position, i)),
          normal(load3<Doubles>(receivers.normal, i)),
          everywhere((normal.x == 0.0) & (normal.y == 0.0) & (normal.z == 0.0)) {}
};

struct Importance {
    Doubles value;
    Mask<Doubles> alike;
};

HWY_INLINE Doubles at_most_one(Doubles x) { return select(x < 1.0, x, 1.0); }

// strength |cos at the light| cos at the receiver / distance^2. The distance is that of the box's middle, at least its
// half diagonal. The cosines are the largest that a point of the box can have: the height over the plane at most, over
// the distance at least. Zero only if the whole box is behind the receiver.
HWY_INLINE Importance importance_of(const Nodes& node, const Receiver& receiver) {
    const Vector<Doubles> way = node.three(offsetof(flat::LightNode, center)) - receiver.position;
    const Vector<Doubles> half = node.three(offsetof(flat::LightNode, half));
    const Doubles strength = node.number(offsetof(flat::LightNode, strength));
    const Doubles spread = node.number(offsetof(flat::LightNode, cos_spread));
    const Doubles d2 = length_squared(way), r2 = length_squared(half);
    const auto gap = [](Doubles along, Doubles side) HWY_ATTR { return max(0.0, abs(along) - side); };
    const Vector<Doubles> gaps{gap(way.x, half.x), gap(way.y, half.y), gap(way.z, half.z)};
    const Doubles over_gap = 1.0 / sqrt(length_squared(gaps));
    Importance i;
    i.value = strength / max(max(d2, r2), 1e-300);  // finite if a light without extent is at the receiver
    i.alike = (kAlikeSquared * r2 <= d2) & ((spread >= kAlikeSpread) | (spread == flat::kNoNormals));
    const Mask<Doubles> planes = spread > 0.0;
    if (any(planes)) {
        const Vector<Doubles> axis = node.three(offsetof(flat::LightNode, axis));
        const Doubles height = abs(dot(axis, way)) + dot(abs(axis), half);
        const Doubles cosine = at_most_one(height * over_gap);  // with the axis
        const Doubles turned = cosine * spread + sqrt((1.0 - cosine * cosine) * (1.0 - spread * spread));
        const Doubles scaled = i.value * select(spread == 1.0, cosine, turned);
        i.value = select(planes & (cosine < spread), scaled, i.value);
    }
    const Doubles middle = dot(receiver.normal, way), height = middle + dot(abs(receiver.normal), half);
    const Mask<Doubles> behind = height <= 0.0;
    const Doubles before = select(behind, 0.0, i.value * at_most_one(height * over_gap));
    i.value = select(receiver.everywhere, i.value, before);
    i.alike = select(receiver.everywhere, i.alike, behind | (i.alike & (middle >= 0.0)));
    // Beyond the range of float.
    const Mask<Doubles> finite = d2 + r2 < kInfinity;
    return {select(finite, i.value, strength), finite & i.alike};
}

// From the root until the lights are alike: by numbers, or to the lights of these ranks.
template <bool to_ranks>
HWY_INLINE void descend_by(const flat::LightTable& lights, const Receivers& receivers, const Row& wanted,
                           Descents& descents) {
    const hn::Rebind<std::uint32_t, Doubles::Tag> words;
    for (std::size_t i = 0; i < receivers.count; i += kLanes<Doubles>) {
        const Receiver receiver(receivers, i);
        const Mask<Doubles> counts = first_lanes<Doubles>(receivers.count - i);  // what lies behind is not set
        Doubles node = 0.0, begin = 0.0, pick = load<Doubles>(wanted + i);
        Importance here = importance_of(Nodes(lights, node), receiver);
        Doubles probability = select(here.value == 0.0, 0.0, Doubles(1.0));
        for (;;) {
            const Doubles right = Nodes(lights, node).index(offsetof(flat::LightNode, right));
            const Mask<Doubles> goes = counts & (!here.alike) & ((probability > 0.0) & (right > 0.0));
            if (!any(goes)) break;
            const Doubles left = select(goes, node + 1.0, node);
            const Nodes at_left(lights, left);
            const Importance a = importance_of(at_left, receiver);
            const Importance b = importance_of(Nodes(lights, select(goes, right, node)), receiver);
            const Doubles sum = a.value + b.value, share = a.value / sum;
            const Doubles end = at_left.index(offsetof(flat::LightNode, end));
            const Mask<Doubles> lost = (!(sum > 0.0)) & goes, goes_left = pick < (to_ranks ? end : share);
            const Doubles chance = probability * select(goes_left, share, 1.0 - share);
            probability = select(goes, select(lost, 0.0, chance), probability);
            if (!to_ranks) {
                const Doubles rest = select(goes_left, pick / share, (pick - share) / (1.0 - share));
                pick = select(goes, select(kLargestPick < rest, kLargestPick, rest), pick);
            }
            begin = select((!goes_left) & goes, end, begin);
            node = select(goes, select(goes_left, left, right), node);
            here.alike = select(goes, select(goes_left, a.alike, b.alike), here.alike);
        }
        store(probability, descents.probability + i);
        store(pick, descents.pick + i);
        hn::StoreU(hn::BitCast(words, hn::DemoteTo(Indices(), node.v)), words, descents.node + i);
        hn::StoreU(hn::BitCast(words, hn::DemoteTo(Indices(), begin.v)), words, descents.begin + i);
    }
}

// Returns the irradiance that a receiver gets from a distant light if nothing is in the way. It is 0 only if the whole
// light is behind the receiver.
HWY_INLINE Doubles irradiance_of(const flat::DistantBounds& light, const Receiver& receiver) {
    const Doubles cosine = dot(receiver.normal, broadcast<Doubles>(light.towards)) + light.sine_radius;
    return light.irradiance * select(receiver.everywhere, 1.0, at_most_one(max(cosine, 0.0)));
}

// With which probability distant lights are chosen: as their part of all light, but for bounds, since nothing is known
// of what is in the way.
HWY_INLINE Doubles share_of_distant(const flat::LightTable& lights, const Receiver& receiver, Doubles distant) {
    if (lights.nodes.empty()) return select(distant > 0.0, Doubles(1.0), 0.0);
    const Doubles near = lights.strength * importance_of(Nodes(lights, 0.0), receiver).value;
    const Doubles share = distant / (distant + near);
    const Doubles bounded = select(share > kLeastShare, min(share, 1.0 - kLeastShare), kLeastShare);
    return select(distant > 0.0, select(near > 0.0, bounded, 1.0), 0.0);
}

// One of the distant lights, in proportion to what they give: by numbers, or with which probability these ranks. The
// numbers are made as good as new where none is chosen.
template <bool to_ranks>
HWY_INLINE void choose_distant_by(const flat::LightTable& lights, const Receivers& receivers, const Row& wanted,
                                  DistantChoices& choices) {
    const double first = static_cast<double>(lights.size());
    for (std::size_t i = 0; i < receivers.count; i += kLanes<Doubles>) {
        const Receiver receiver(receivers, i);
        Doubles sum = 0.0;
        for (const flat::DistantLight& distant : lights.distant) sum = sum + irradiance_of(distant.bounds, receiver);
        const Doubles share = share_of_distant(lights, receiver, sum), number = load<Doubles>(wanted + i);
        const Doubles target = number / share * sum;
        Doubles before = 0.0, rank = first, probability = 0.0;
        for (std::size_t k = 0; k < lights.distant.size(); ++k) {
            const Doubles of_it = irradiance_of(lights.distant[k].bounds, receiver);
            const Doubles its_rank = first + static_cast<double>(k);
            const Mask<Doubles> found = to_ranks ? number == its_rank : (of_it > 0.0) & (before <= target);
            rank = select(found, its_rank, rank);
            probability = select(found, of_it / sum * share, probability);
            before = before + of_it;
        }
        store(share, choices.share + i), store(rank, choices.rank + i), store(probability, choices.probability + i);
        if (to_ranks) continue;
        const Doubles rest = (number - share) / (1.0 - share);
        store(select(number < share, 0.0, select(kLargestPick < rest, kLargestPick, rest)), choices.pick + i);
    }
}

void choose_distant(const flat::LightTable& lights, const Receivers& receivers, const Row& pick,
                    DistantChoices& choices) {
    choose_distant_by<false>(lights, receivers, pick, choices);
}

void find_distant(const flat::LightTable& lights, const Receivers& receivers, const Row& rank,
                  DistantChoices& choices) {
    choose_distant_by<true>(lights, receivers, rank, choices);
}

void descend(const flat::LightTable& lights, const Receivers& receivers, const Row& pick, Descents& descents) {
    descend_by<false>(lights, receivers, pick, descents);
}

void descend_to(const flat::LightTable& lights, const Receivers& receivers, const Row& rank, Descents& descents) {
    descend_by<true>(lights, receivers, rank, descents);
}

}  // namespace limn::lights::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace limn::lights {

HWY_EXPORT(descend);
HWY_EXPORT(descend_to);
HWY_EXPORT(choose_distant);
HWY_EXPORT(find_distant);

namespace {

// Of the lights where a descent ended, in proportion to their strength.
Choice choose_alike(const flat::LightTable& lights, const Descents& at, std::size_t i) {
    if (!(at.probability[i] > 0)) return {};
    const auto& before = lights.strength_before;
    const auto first = before.begin() + at.begin[i];
    const auto last = before.begin() + lights.nodes[at.node[i]].end;
    if (last - first == 1) return {at.begin[i], at.probability[i]};
    const double strength = *last - *first, wanted = *first + at.pick[i] * strength;
    // The guide narrows the search.
    const auto place =
        std::min(static_cast<std::size_t>(wanted * static_cast<double>(lights.size())), lights.size() - 1);
    const auto from = std::max(first, before.begin() + lights.guide[place]) + 1;
    const auto to = std::min(last, before.begin() + lights.guide[place + 1] + 1);
    const auto after = from < to ? std::upper_bound(from, to, wanted) : from < last ? from : last;
    return {static_cast<std::size_t>(after - 1 - before.begin()),
            at.probability[i] * ((*after - *(after - 1)) / strength)};
}

// Of the lights in the tree.
void choose_near(const flat::LightTable& lights, const Receivers& receivers, const Row& pick, Choice* choices) {
    if (lights.nodes.empty()) {
        std::fill_n(choices, receivers.count, Choice{0, 1});
        return;
    }
    Descents descents;
    HWY_DYNAMIC_DISPATCH(descend)(lights, receivers, pick, descents);
    for (std::size_t i = 0; i < receivers.count; ++i) choices[i] = choose_alike(lights, descents, i);
}

void find_near_probability(const flat::LightTable& lights, const Receivers& receivers, const Row& rank,
                           Row& probability) {
    std::fill_n(probability, receivers.count, 1.0);
    if (lights.nodes.empty()) return;
    Descents at;
    HWY_DYNAMIC_DISPATCH(descend_to)(lights, receivers, rank, at);
    for (std::size_t i = 0; i < receivers.count; ++i) {
        probability[i] = at.probability[i];
        const std::vector<double>& before = lights.strength_before;
        const std::size_t begin = at.begin[i], end = lights.nodes[at.node[i]].end;
        const auto light = static_cast<std::size_t>(rank[i]);
        if (end - begin > 1) probability[i] *= (before[light + 1] - before[light]) / (before[end] - before[begin]);
    }
}

}  // namespace

void choose(const flat::LightTable& lights, const Receivers& receivers, const Row& pick, Choice* choices) {
    if (lights.distant.empty()) return choose_near(lights, receivers, pick, choices);
    DistantChoices distant;
    HWY_DYNAMIC_DISPATCH(choose_distant)(lights, receivers, pick, distant);
    choose_near(lights, receivers, distant.pick, choices);
    for (std::size_t i = 0; i < receivers.count; ++i) {
        if (pick[i] < distant.share[i] || lights.size() == 0)
            choices[i] = {static_cast<std::size_t>(distant.rank[i]), distant.probability[i]};
        else
            choices[i].probability *= 1 - distant.share[i];
    }
}

void find_probability(const flat::LightTable& lights, const Receivers& receivers, const Row& rank, Row& probability) {
    if (lights.distant.empty()) return find_near_probability(lights, receivers, rank, probability);
    DistantChoices distant;
    HWY_DYNAMIC_DISPATCH(find_distant)(lights, receivers, rank, distant);
    // Of the ranks of distant lights nothing is asked in the tree.
    const double first = static_cast<double>(lights.size());
    Row near;
    for (std::size_t i = 0; i < receivers.count; ++i) near[i] = rank[i] < first ? rank[i] : 0;
    find_near_probability(lights, receivers, near, probability);
    for (std::size_t i = 0; i < receivers.count; ++i)
        probability[i] = rank[i] < first ? probability[i] * (1 - distant.share[i]) : distant.probability[i];
}

}  // namespace limn::lights
#endif

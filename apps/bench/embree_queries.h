// Embree's queries, one size of packet at a time: the C interface has a function for each.
#pragma once

#include <embree3/rtcore.h>

#include <cstddef>

namespace limn::bench {

// Lanes: how many rays a packet has.
template <int kLanes>
struct PacketOf;

template <>
struct PacketOf<4> {
    using Ray = RTCRay4;
    using RayHit = RTCRayHit4;
    static constexpr auto intersect = rtcIntersect4;
    static constexpr auto occluded = rtcOccluded4;
};
template <>
struct PacketOf<8> {
    using Ray = RTCRay8;
    using RayHit = RTCRayHit8;
    static constexpr auto intersect = rtcIntersect8;
    static constexpr auto occluded = rtcOccluded8;
};
template <>
struct PacketOf<16> {
    using Ray = RTCRay16;
    using RayHit = RTCRayHit16;
    static constexpr auto intersect = rtcIntersect16;
    static constexpr auto occluded = rtcOccluded16;
};

}  // namespace limn::bench

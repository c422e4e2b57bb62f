// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "tests/unit/scene/collide/crowd.hpp"

#include <gtest/gtest.h>
#include <set>

namespace hapnet::scene {
namespace {

constexpr std::uint64_t seeds = 4;
constexpr int ticks = 60;
constexpr double tick_s = 1e-3;

double between(const base::RandomStream& chance, std::uint64_t& draw, double low, double high)
{
    return low + (high - low) * chance.uniform(draw++);
}

glm::dvec3 vector_within(const base::RandomStream& chance, std::uint64_t& draw, double size)
{
    const double x = between(chance, draw, -size, size);
    const double y = between(chance, draw, -size, size);
    return {x, y, between(chance, draw, -size, size)};
}

/// A slow, fast or very fast speed, with the ratios of 1 mm/s to 1000 m/s.
double some_speed(const base::RandomStream& chance, std::uint64_t& draw)
{
    constexpr std::array<double, 6> speeds{1e-3, 0.1, 1.0, 10.0, 100.0, 1000.0};
    return speeds[chance.below(speeds.size(), draw++)];
}

/// Bodies of very different sizes, in any orientation, some fixed, in a room of 40 cm.
Description random_scene(const base::RandomStream& chance, std::uint64_t& draw)
{
    Description description;
    for (int i = 0; i < 26; ++i) {
        BodyDescription body;
        const double size = i == 0 ? 0.3 : 0.02;
        body.half = glm::dvec3{between(chance, draw, 0.1, 1.0), between(chance, draw, 0.1, 1.0),
                               between(chance, draw, 0.1, 1.0)} *
                    size;
        body.position = base::Position{vector_within(chance, draw, 0.2)};
        const glm::dvec3 axis = vector_within(chance, draw, 1.0);
        body.orientation = base::normalized({1.0, axis.x, axis.y, axis.z});
        body.movable = i % 5 != 0;
        if (i % 3 == 1) body.turning = Turning::locked;
        if (body.movable)
            body.velocity = base::Velocity{vector_within(chance, draw, some_speed(chance, draw))};
        description.bodies.push_back(body);
    }
    description.planes = {
        PlaneDescription{.name = "floor", .offset_m = -0.2},
        PlaneDescription{.name = "slope", .normal = {0.6, 0.8, 0.0}, .offset_m = -0.2}};
    description.hands.count = 2;
    return description;
}

/// The axis-aligned box of a body's sweep in this tick, with nearby_margin.
Aabb swept(const Bodies& bodies, Slot slot)
{
    const glm::dvec3 half = bodies.properties[slot].half;
    const glm::dmat3 axes = glm::mat3_cast(bodies.orientation.at(slot));
    glm::dvec3 extent{pair_margin * std::min({half.x, half.y, half.z})};
    for (int axis : {0, 1, 2}) extent += glm::abs(axes[axis]) * half[axis];
    const glm::dvec3 from = bodies.position.at(slot);
    return grown(hull(from, from + bodies.velocity.at(slot) * tick_s), extent);
}

void turn(Bodies& bodies, Slot slot)
{
    const glm::dvec3 w = bodies.angular_velocity(slot);
    const glm::dquat q = bodies.orientation.at(slot);
    const glm::dquat rate = glm::dquat{0.0, w.x, w.y, w.z} * q;
    bodies.orientation.put(slot, base::normalized(q + rate * (0.5 * tick_s)));
}

/// Outside influences: hits, new places, falling asleep and waking.
template <BroadPhase broad_phase>
void disturb(Crowd<broad_phase>& crowd, const base::RandomStream& chance, std::uint64_t& draw)
{
    Bodies& bodies = crowd.bodies;
    for (Slot slot = 0; slot < bodies.awake; ++slot) {
        if (chance.below(20, draw++) == 0)
            bodies.velocity.put(slot, vector_within(chance, draw, some_speed(chance, draw)));
        if (chance.below(30, draw++) == 0)
            bodies.position.put(slot, vector_within(chance, draw, 0.2));
        if (chance.below(30, draw++) == 0)
            bodies.set_angular_velocity(slot,
                                        vector_within(chance, draw, some_speed(chance, draw)));
    }
    if (bodies.awake > 3 && chance.below(3, draw++) == 0)
        crowd.sleep(bodies.properties[chance.below(bodies.awake, draw++)].id);
    if (bodies.awake < bodies.movable && chance.below(3, draw++) == 0)
        crowd.wake(bodies.properties[bodies.awake].id);
}

template <BroadPhase broad_phase>
void expect_all_found(Crowd<broad_phase>& crowd)
{
    const Bodies& bodies = crowd.bodies;
    const auto pairs = crowd.pairs();
    ASSERT_TRUE(std::is_sorted(pairs.begin(), pairs.end()));
    ASSERT_EQ(std::adjacent_find(pairs.begin(), pairs.end()), pairs.end());
    std::vector<Aabb> boxes(bodies.size());
    for (BodyId id = 0; id < bodies.size(); ++id) boxes[id] = swept(bodies, bodies.slot_of[id]);
    std::size_t found = 0;
    for (BodyId a = 0; a < bodies.size(); ++a)
        for (BodyId b = a + 1; b < bodies.size(); ++b) {
            const bool is_active = std::min(bodies.slot_of[a], bodies.slot_of[b]) < bodies.awake;
            const bool is_found = std::binary_search(pairs.begin(), pairs.end(), std::pair{a, b});
            if (is_found) ++found;
            const bool is_needed = is_active && overlap(boxes[a], boxes[b]);
            ASSERT_TRUE(is_found ? is_active : !is_needed) << a << ' ' << b;
        }
    ASSERT_EQ(found, pairs.size());
}

/// True if the lowest corner of a swept box is below a plane.
template <BroadPhase broad_phase>
void expect_planes_found(Crowd<broad_phase>& crowd)
{
    const auto pairs = crowd.plane_pairs();
    ASSERT_TRUE(std::is_sorted(pairs.begin(), pairs.end()));
    for (Slot slot = 0; slot < crowd.bodies.awake; ++slot) {
        const Aabb box = swept(crowd.bodies, slot);
        for (std::uint32_t plane = 0; plane < crowd.config.planes.size(); ++plane) {
            const PlaneDescription& p = crowd.config.planes[plane];
            double lowest = -p.offset_m;
            for (int axis : {0, 1, 2})
                lowest += std::min(p.normal[axis] * box.low[axis], p.normal[axis] * box.high[axis]);
            const std::pair<BodyId, BodyId> wanted{crowd.bodies.properties[slot].id, plane};
            ASSERT_TRUE(lowest > 0.0 || std::binary_search(pairs.begin(), pairs.end(), wanted));
        }
    }
}

template <BroadPhase broad_phase>
void expect_hands_find(Crowd<broad_phase>& crowd, std::uint32_t hand, const HandPath& path)
{
    const auto reached = crowd.pair_finder.near_hand(hand, path);
    ASSERT_TRUE(std::is_sorted(reached.begin(), reached.end()));
    const Aabb sphere = grown(hull(path.from, path.to), glm::dvec3{path.radius});
    for (Slot slot = 0; slot < crowd.bodies.size(); ++slot)
        ASSERT_TRUE(
            !overlap(swept(crowd.bodies, slot), sphere) ||
            std::binary_search(reached.begin(), reached.end(), crowd.bodies.properties[slot].id));
}

template <BroadPhase broad_phase>
void expect_nobody_is_missed(std::uint64_t seed)
{
    const base::RandomStream chance = base::Seed{seed}.stream("broadphase");
    std::uint64_t draw = 0;
    Crowd<broad_phase> crowd{random_scene(chance, draw)};
    std::array<HandPath, 2> hands{HandPath{{}, {}, 0.005}, HandPath{{}, {}, 0.005}};
    std::array<glm::dvec3, 2> step{};
    for (int tick = 0; tick < ticks; ++tick) {
        disturb(crowd, chance, draw);
        crowd.pair_finder.update(crowd.bodies);
        expect_all_found(crowd);
        expect_planes_found(crowd);
        for (std::uint32_t hand : {0U, 1U}) {
            if (chance.below(20, draw++) == 0) step[hand] = vector_within(chance, draw, 1e-3);
            if (chance.below(40, draw++) == 0) hands[hand].to = vector_within(chance, draw, 0.2);
            hands[hand].from = hands[hand].to;
            hands[hand].to += step[hand];
            expect_hands_find(crowd, hand, hands[hand]);
        }
        if (testing::Test::HasFatalFailure()) {
            ADD_FAILURE() << "seed " << seed << ", tick " << tick;
            return;
        }
        for (Slot slot = 0; slot < crowd.bodies.awake; ++slot) {
            const glm::dvec3 way = crowd.bodies.velocity.at(slot) * tick_s;
            crowd.bodies.position.put(slot, crowd.bodies.position.at(slot) + way);
            turn(crowd.bodies, slot);
        }
    }
    EXPECT_EQ(crowd.pair_finder.counts().pairs_left_out, 0U);
}

TEST(AabbScan, MissesNobodyInRandomScenesUpTo1000MetresPerSecond)
{
    for (std::uint64_t seed = 1; seed <= seeds; ++seed)
        expect_nobody_is_missed<BroadPhase::all_pairs>(seed);
}

TEST(Grid, MissesNobodyInRandomScenesUpTo1000MetresPerSecond)
{
    for (std::uint64_t seed = 1; seed <= seeds; ++seed)
        expect_nobody_is_missed<BroadPhase::grid>(seed);
}

TEST(PairFinder, AreTheSameByAScanAndByAGrid)
{
    const base::RandomStream chance = base::Seed{7}.stream("both");
    std::uint64_t draw = 0;
    const Description scene = random_scene(chance, draw);
    Crowd<BroadPhase::all_pairs> scan{scene};
    Crowd<BroadPhase::grid> grid{scene};
    for (int tick = 0; tick < ticks; ++tick) {
        std::uint64_t same = draw;
        disturb(scan, chance, same);
        disturb(grid, chance, draw);
        scan.pair_finder.update(scan.bodies);
        grid.pair_finder.update(grid.bodies);
        ASSERT_EQ(scan.pairs(), grid.pairs());
        ASSERT_EQ(scan.plane_pairs(), grid.plane_pairs());
    }
}

} // namespace
} // namespace hapnet::scene

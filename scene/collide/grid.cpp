// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "scene/collide/grid.hpp"

#include <algorithm>
#include <bit>

namespace hapnet::scene {

namespace {

// Bodies that lie farther out share the cells of the border, which is slow but still correct.
constexpr double cells_max = 1 << 20;
constexpr unsigned cell_bits = 21;
// The edge of a cell, in edges of the median box. It is so long that a box that reaches far ahead
// still lies in few cells.
constexpr double cell_edges = 3.0;

double largest_edge(const Aabb& box)
{
    const glm::dvec3 size = box.size();
    return std::max({size.x, size.y, size.z});
}

double median_edge(std::span<const Aabb> boxes)
{
    if (boxes.empty()) return 1.0;
    std::vector<double> edges;
    edges.reserve(boxes.size());
    for (const Aabb& box : boxes) edges.push_back(largest_edge(box));
    const auto middle = edges.begin() + static_cast<std::ptrdiff_t>(edges.size() / 2);
    std::nth_element(edges.begin(), middle, edges.end());
    return *middle;
}

} // namespace

Grid::Grid(std::span<const Aabb> boxes)
    : nodes_(boxes.size()),
      entries_(boxes.size() * cells_each),
      heads_(std::bit_ceil(4 * boxes.size() + 1), none),
      large_{boxes.size()},
      cell_{cell_edges * median_edge(boxes)},
      cells_per_m_{1.0 / cell_},
      mask_{heads_.size() - 1}
{
    for (BodyId id = 0; id < nodes_.size(); ++id) {
        nodes_[id].box = boxes[id];
        nodes_[id].cells = cells_of(boxes[id]);
        put_in(id);
    }
}

void Grid::move(BodyId id, const Aabb& box)
{
    Node& node = nodes_[id];
    const Cells cells = cells_of(box);
    node.box = box;
    if (cells == node.cells) return;
    take_out(id);
    node.cells = cells;
    put_in(id);
}

std::int32_t Grid::cell_at(double coordinate) const
{
    // A floor in four instructions: without SSE4.1 std::floor takes twenty. In this order NaN has a
    // cell, too.
    const double inside = std::min(cells_max - 1.0, coordinate * cells_per_m_);
    const double cell = std::max(-cells_max, inside);
    const auto towards_zero = static_cast<std::int32_t>(cell);
    return towards_zero - static_cast<std::int32_t>(static_cast<double>(towards_zero) > cell);
}

Grid::Cells Grid::cells_of(const Aabb& box) const
{
    return {{cell_at(box.low.x), cell_at(box.low.y), cell_at(box.low.z)},
            {cell_at(box.high.x), cell_at(box.high.y), cell_at(box.high.z)}};
}

double Grid::Cells::count() const
{
    const auto along = [](std::int32_t from, std::int32_t to) {
        return static_cast<double>(to - from + 1);
    };
    return along(low.x, high.x) * along(low.y, high.y) * along(low.z, high.z);
}

std::uint64_t Grid::key_of(const Cell& cell)
{
    constexpr std::uint64_t field = (std::uint64_t{1} << cell_bits) - 1;
    const auto bits = [](std::int32_t value) { return static_cast<std::uint64_t>(value) & field; };
    return bits(cell.z) << 2 * cell_bits | bits(cell.y) << cell_bits | bits(cell.x);
}

/// Returns the bucket of a cell. Cells that are neighbours along x have neighbouring buckets.
std::size_t Grid::bucket_of(std::uint64_t key) const
{
    constexpr std::uint64_t spread = 0x9E3779B97F4A7C15; // 2^64 / golden ratio (Knuth 6.4)
    return (key + ((key >> cell_bits) * spread >> 20U)) & mask_;
}

void Grid::put_in(BodyId id)
{
    Node& node = nodes_[id];
    const auto& [low, high] = node.cells;
    if (node.cells.count() > static_cast<double>(cells_each)) {
        node.place_in_large = static_cast<BodyId>(large_.size());
        large_.add(id);
        return;
    }
    node.place_in_large = none;
    Link link = id * cells_each;
    for (std::int32_t z = low.z; z <= high.z; ++z)
        for (std::int32_t y = low.y; y <= high.y; ++y)
            for (std::int32_t x = low.x; x <= high.x; ++x, ++link) {
                const std::uint64_t key = key_of({x, y, z});
                Link& head = heads_[bucket_of(key)];
                entries_[link] = {key, head, none};
                if (head != none) entries_[head].previous = link;
                head = link;
            }
}

void Grid::take_out(BodyId id)
{
    const Node& node = nodes_[id];
    if (node.place_in_large != none) {
        const BodyId last = large_.take_last();
        if (last != id) large_[node.place_in_large] = last;
        nodes_[last].place_in_large = node.place_in_large;
        return;
    }
    const auto count = static_cast<Link>(node.cells.count());
    for (Link link = id * cells_each; link < id * cells_each + count; ++link) {
        const Entry& entry = entries_[link];
        if (entry.next != none) entries_[entry.next].previous = entry.previous;
        (entry.previous != none ? entries_[entry.previous].next : heads_[bucket_of(entry.key)]) =
            entry.next;
    }
}

} // namespace hapnet::scene

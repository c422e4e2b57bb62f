// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "peer/core/scene/broadphase/grid.hpp"

#include <algorithm>
#include <bit>
#include <cmath>

namespace hapnet::scene {

namespace {

// Farther out bodies share the cells of the border: slow there, and still right.
constexpr double cells_max = 1 << 20;
constexpr unsigned cell_bits = 21;

double largest_edge(const Box& box)
{
    const glm::dvec3 size = box.size();
    return std::max({size.x, size.y, size.z});
}

double median_edge(std::span<const Box> boxes)
{
    if (boxes.empty()) return 1.0;
    std::vector<double> edges;
    edges.reserve(boxes.size());
    for (const Box& box : boxes) edges.push_back(largest_edge(box));
    const auto middle = edges.begin() + static_cast<std::ptrdiff_t>(edges.size() / 2);
    std::nth_element(edges.begin(), middle, edges.end());
    return *middle;
}

} // namespace

Grid::Grid(std::span<const Box> boxes)
    : nodes_(boxes.size()),
      heads_(std::bit_ceil(2 * boxes.size() + 1), none),
      large_{boxes.size()},
      cell_{2.0 * median_edge(boxes)},
      cells_per_m_{1.0 / cell_},
      mask_{heads_.size() - 1}
{
    for (BodyId id = 0; id < nodes_.size(); ++id) {
        nodes_[id].box = boxes[id];
        put_in(id);
    }
}

void Grid::move(BodyId id, const Box& box)
{
    take_out(id);
    nodes_[id].box = box;
    put_in(id);
}

std::int64_t Grid::cell_at(double coordinate) const
{
    const double cell = std::floor(coordinate * cells_per_m_);
    return static_cast<std::int64_t>(std::clamp(cell, -cells_max, cells_max - 1.0));
}

Grid::Cells Grid::cells_of(const Box& box) const
{
    // What reaches into the box lies at most half its own size, half a cell, outside. A little
    // more: the centre of a box is a rounded number.
    const glm::dvec3 reach{0.5 * (1.0 + 0x1p-20) * cell_};
    const Box wide = grown(box, reach);
    return {{cell_at(wide.low.x), cell_at(wide.low.y), cell_at(wide.low.z)},
            {cell_at(wide.high.x), cell_at(wide.high.y), cell_at(wide.high.z)}};
}

double Grid::Cells::count() const
{
    double product = 1.0;
    for (std::size_t axis = 0; axis < 3; ++axis)
        product *= static_cast<double>(high[axis] - low[axis] + 1);
    return product;
}

std::uint64_t Grid::key_of(const Cell& cell)
{
    constexpr std::uint64_t field = (std::uint64_t{1} << cell_bits) - 1;
    return (static_cast<std::uint64_t>(cell[2]) & field) << 2 * cell_bits |
           (static_cast<std::uint64_t>(cell[1]) & field) << cell_bits |
           (static_cast<std::uint64_t>(cell[0]) & field);
}

/// Cells that lie side by side along x have buckets side by side.
std::size_t Grid::bucket_of(std::uint64_t key) const
{
    constexpr std::uint64_t spread = 0x9E3779B97F4A7C15; // 2^64 / golden ratio (Knuth 6.4)
    return (key + ((key >> cell_bits) * spread >> 20U)) & mask_;
}

void Grid::put_in(BodyId id)
{
    Node& node = nodes_[id];
    if (largest_edge(node.box) > cell_) {
        node.key = key_of_large;
        node.previous = static_cast<BodyId>(large_.size());
        large_.add(id);
        return;
    }
    const glm::dvec3 centre = node.box.centre();
    node.key = key_of({cell_at(centre.x), cell_at(centre.y), cell_at(centre.z)});
    BodyId& head = heads_[bucket_of(node.key)];
    node.previous = none;
    node.next = head;
    if (head != none) nodes_[head].previous = id;
    head = id;
}

void Grid::take_out(BodyId id)
{
    const Node& node = nodes_[id];
    if (node.key == key_of_large) {
        const BodyId last = large_.take_last();
        if (last != id) large_[node.previous] = last;
        nodes_[last].previous = node.previous;
        return;
    }
    if (node.next != none) nodes_[node.next].previous = node.previous;
    (node.previous != none ? nodes_[node.previous].next : heads_[bucket_of(node.key)]) = node.next;
}

} // namespace hapnet::scene

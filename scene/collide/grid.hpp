// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

#include "scene/bodies.hpp"
#include "scene/bounded.hpp"
#include "scene/collide/aabb.hpp"

#include <algorithm>
#include <span>
#include <vector>

namespace hapnet::scene {

/// Finds overlaps through a uniform grid whose cells are hashed into buckets. A body lies in every
/// cell that its box reaches into. Cells are three times the median box. A body whose box reaches
/// into too many cells lies in a separate list. The set of overlaps does not depend on the order in
/// which bodies were added, but the order of the visits does.
class Grid {
public:
    /// `boxes` holds the boxes of all bodies, by their ids.
    explicit Grid(std::span<const Aabb> boxes);

    [[nodiscard]] const Aabb& box(BodyId id) const { return nodes_[id].box; }
    void move(BodyId id, const Aabb& box);

    /// Calls visit(id) for every body whose box overlaps that of the body `id`, and for that body
    /// itself.
    template <typename Visit>
    void for_overlapping(BodyId id, Visit visit) const
    {
        for_overlapping(nodes_[id].box, nodes_[id].cells, visit);
    }
    /// Calls visit(id) once for every body whose box overlaps `box`.
    template <typename Visit>
    void for_overlapping(const Aabb& box, Visit visit) const
    {
        for_overlapping(box, cells_of(box), visit);
    }

private:
    using Link = std::uint32_t; // index of an entry, which belongs to the body link / cells_each
    static constexpr Link none = ~Link{0};
    static constexpr Link cells_each = 18; // 3 by 3 by 2

    struct Cell {
        std::int32_t x = 0;
        std::int32_t y = 0;
        std::int32_t z = 0;
        friend bool operator==(const Cell&, const Cell&) = default;
    };
    struct Cells {
        Cell low;
        Cell high;
        [[nodiscard]] double count() const;
        friend bool operator==(const Cells&, const Cells&) = default;
    };
    struct Node {
        Aabb box;
        Cells cells;
        BodyId place_in_large = none; // none: the body is in the cells
    };
    /// A body in a cell; two cells may share a bucket.
    struct Entry {
        std::uint64_t key = 0;
        Link next = none;
        Link previous = none;
    };
    struct Query {
        const Aabb& box;
        const Cell& low;
    };

    [[nodiscard]] std::int32_t cell_at(double coordinate) const;
    [[nodiscard]] Cells cells_of(const Aabb& box) const;
    [[nodiscard]] static std::uint64_t key_of(const Cell& cell);
    [[nodiscard]] std::size_t bucket_of(std::uint64_t key) const;
    void put_in(BodyId id);
    void take_out(BodyId id);

    template <typename Visit>
    void for_overlapping(const Aabb& box, const Cells& cells, Visit& visit) const
    {
        if (cells.count() > static_cast<double>(nodes_.size())) {
            for (BodyId id = 0; id < nodes_.size(); ++id)
                if (overlap(nodes_[id].box, box)) visit(id);
            return;
        }
        for (const BodyId id : large_)
            if (overlap(nodes_[id].box, box)) visit(id);
        for (std::int32_t z = cells.low.z; z <= cells.high.z; ++z)
            for (std::int32_t y = cells.low.y; y <= cells.high.y; ++y)
                for (std::int32_t x = cells.low.x; x <= cells.high.x; ++x)
                    visit_cell({x, y, z}, {box, cells.low}, visit);
    }

    /// Visits the bodies of a cell. A body that shares several cells with the query is visited only
    /// in the lowest of them.
    template <typename Visit>
    void visit_cell(const Cell& cell, const Query& asked, Visit& visit) const
    {
        const std::uint64_t key = key_of(cell);
        for (Link link = heads_[bucket_of(key)]; link != none; link = entries_[link].next) {
            if (entries_[link].key != key) continue;
            const BodyId id = link / cells_each;
            const Node& node = nodes_[id];
            if (!overlap(node.box, asked.box)) continue;
            const Cell& low = node.cells.low;
            if (cell == Cell{std::max(low.x, asked.low.x), std::max(low.y, asked.low.y),
                             std::max(low.z, asked.low.z)})
                visit(id);
        }
    }

    std::vector<Node> nodes_;    // by BodyId
    std::vector<Entry> entries_; // cells_each for every body
    std::vector<Link> heads_;    // first entry of each bucket
    Bounded<BodyId> large_;
    double cell_ = 1.0;
    double cells_per_m_ = 1.0;
    std::uint64_t mask_ = 0;
};

} // namespace hapnet::scene

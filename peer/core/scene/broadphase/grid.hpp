// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

#include "peer/core/scene/bodies.hpp"
#include "peer/core/scene/bounded.hpp"
#include "peer/core/scene/broadphase/box.hpp"

#include <array>
#include <span>
#include <vector>

namespace hapnet::scene {

/// Finds who is near through a uniform grid, its cells hashed into buckets. A body lies in the one
/// cell of its box's centre; cells are twice the median box, and what is larger than a cell lies
/// in a list of its own. Whom it finds does not depend on the order in which bodies were put in;
/// the order in which it finds them does.
class Grid {
public:
    /// The boxes of all bodies, by their ids.
    explicit Grid(std::span<const Box> boxes);

    [[nodiscard]] const Box& box(BodyId id) const { return nodes_[id].box; }
    void move(BodyId id, const Box& box);

    /// Calls visit(id) for every body whose box overlaps the given.
    template <typename Visit>
    void near(const Box& box, Visit visit) const
    {
        const Cells cells = cells_of(box);
        if (cells.count() > many_cells && cells.count() > static_cast<double>(nodes_.size())) {
            for (BodyId id = 0; id < nodes_.size(); ++id)
                if (overlap(nodes_[id].box, box)) visit(id);
            return;
        }
        for (const BodyId id : large_)
            if (overlap(nodes_[id].box, box)) visit(id);
        for (std::int64_t z = cells.low[2]; z <= cells.high[2]; ++z)
            for (std::int64_t y = cells.low[1]; y <= cells.high[1]; ++y)
                for (std::int64_t x = cells.low[0]; x <= cells.high[0]; ++x)
                    visit_cell({x, y, z}, box, visit);
    }

    [[nodiscard]] double cell_m() const { return cell_; }

private:
    static constexpr BodyId none = ~BodyId{0};
    static constexpr std::uint64_t key_of_large = ~std::uint64_t{0};
    static constexpr double many_cells = 64.0;

    using Cell = std::array<std::int64_t, 3>;
    struct Cells {
        Cell low;
        Cell high;
        [[nodiscard]] double count() const;
    };
    /// A cache line.
    struct alignas(64) Node {
        Box box;
        std::uint64_t key = 0; // of its cell; two cells may share a bucket
        BodyId next = none;
        BodyId previous = none; // of the large ones: the place in their list
    };

    [[nodiscard]] std::int64_t cell_at(double coordinate) const;
    [[nodiscard]] Cells cells_of(const Box& box) const;
    [[nodiscard]] static std::uint64_t key_of(const Cell& cell);
    [[nodiscard]] std::size_t bucket_of(std::uint64_t key) const;
    void put_in(BodyId id);
    void take_out(BodyId id);

    template <typename Visit>
    void visit_cell(const Cell& cell, const Box& box, Visit& visit) const
    {
        const std::uint64_t key = key_of(cell);
        for (BodyId id = heads_[bucket_of(key)]; id != none; id = nodes_[id].next)
            if (nodes_[id].key == key && overlap(nodes_[id].box, box)) visit(id);
    }

    std::vector<Node> nodes_; // by id
    std::vector<BodyId> heads_;
    Bounded<BodyId> large_;
    double cell_ = 1.0;
    double cells_per_m_ = 1.0;
    std::uint64_t mask_ = 0;
};

} // namespace hapnet::scene

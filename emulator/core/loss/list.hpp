// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

#include "emulator/core/loss/theory.hpp"
#include "emulator/core/packet.hpp"
#include "proto/base/random.hpp"
#include "proto/base/result.hpp"
#include "proto/base/shared_vector.hpp"

#include <cstddef>
#include <cstdint>
#include <vector>

namespace hapnet::emulator {

/// Loses the datagrams of these numbers, which ascend.
struct ListedLoss {
    base::SharedVector<std::uint64_t> numbers;

    static constexpr DropCause cause = DropCause::listed_loss;
    static constexpr bool is_in_time = false;
    class Model;

    [[nodiscard]] base::Result<void> validate() const;
    [[nodiscard]] LossTheory theory(const Arrivals&) const;
    [[nodiscard]] std::vector<LossProperty> properties(const RunFacts&) const;

    friend bool operator==(const ListedLoss&, const ListedLoss&) = default;
};

constexpr auto fields_of(base::Tag<ListedLoss>)
{
    return base::fields("list", base::field("numbers", &ListedLoss::numbers,
                                            "numbers of the lost datagrams, ascending")
                                    .required());
}

/// Keeps its place in the list.
class ListedLoss::Model {
public:
    Model(const ListedLoss& law, const base::RandomStream&) : law_{law} {}

    [[nodiscard]] bool on_packet(const Packet& packet, const base::RandomStream&);
    void change(const ListedLoss& law, const base::RandomStream&);

private:
    ListedLoss law_;
    std::size_t next_ = 0; // index of the first listed number that is not over
};

} // namespace hapnet::emulator

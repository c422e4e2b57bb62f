// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

#include "peer/core/sync/base_algorithm.hpp"
#include "peer/core/sync/energy_at_an_omni.hpp"

#include <cstdint>
#include <optional>
#include <vector>

namespace hapnet::peer {

struct BaseTdpaOptions {
    double damping_max_ns_per_m = 30.0; // greatest damping that the controller adds
    BaseOptions base{};

    friend bool operator==(const BaseTdpaOptions&, const BaseTdpaOptions&) = default;
};
constexpr auto fields_of(base::Tag<BaseTdpaOptions> /*struct*/)
{
    using Options = BaseTdpaOptions;
    return base::fields("base-tdpa",
                        base::field("damping_max", &Options::damping_max_ns_per_m,
                                    base::Quantity{base::damping_kind, 0.0, 1000.0},
                                    "most damping that the passivity controller adds"),
                        base::part(&Options::base));
}

/// The base algorithm with a time-domain passivity controller (Hannaford and Ryu 2002; with two
/// ports and a delay between them Ryu, Artigas and Preusche 2010). The observer compares the work
/// that the other hands have put into their devices, by their running sums, with the work of their
/// forces in this copy. While the latter is greater, the controller damps the body. It relies on no
/// model and no clock. docs/design/algorithms.md has the equations.
class BaseTdpa {
public:
    /// The energy that the algorithm may bring into a hand at an Omni.
    static constexpr auto energy_limits = energy_at_an_omni(0.5, 0.2);

    BaseTdpa() = default;
    explicit BaseTdpa(const BaseTdpaOptions& options) : options_{options}, base_{options.base} {}

    /// Allocates the memory for this number of other peers.
    void prepare(std::size_t others) { work_uj_.assign(others, std::nullopt); }
    void hear(const ReceivedState& received);
    [[nodiscard]] Outcome tick(scene::World& world, const Situation& situation);
    void forget(std::size_t of = 0);

    [[nodiscard]] const BaseTdpaOptions& options() const { return options_; }
    /// Returns the energy that the others have put in and this copy has not received, in J. It is
    /// negative while damping is due.
    [[nodiscard]] double observed_j() const { return observed_j_; }

private:
    [[nodiscard]] base::Force damping_force(base::Force remote, base::Velocity velocity,
                                            double mass_kg, const Situation& situation) const;

    BaseTdpaOptions options_;
    BaseAlgorithm base_;
    std::vector<std::optional<std::uint32_t>> work_uj_; // the last received work of each other peer
    double observed_j_ = 0.0;
    bool follows_ = false; // only other hands touched the body in the last tick
};

} // namespace hapnet::peer

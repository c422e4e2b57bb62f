// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

#include "peer/core/sync/at_rest.hpp"
#include "peer/core/sync/energy_at_an_omni.hpp"
#include "peer/core/sync/recent_age.hpp"

#include <glm/vec3.hpp>
#include <vector>

namespace hapnet::peer {

struct CoupleOptions {
    double stiffness_max_n_per_m = 300.0;
    double tank_j = 0.020;

    friend bool operator==(const CoupleOptions&, const CoupleOptions&) = default;
};
constexpr auto fields_of(base::Tag<CoupleOptions> /*struct*/)
{
    using Options = CoupleOptions;
    return base::fields(
        "couple",
        base::field("stiffness_max", &Options::stiffness_max_n_per_m,
                    base::Quantity{base::stiffness_kind, 1.0, 5000.0},
                    "stiffest spring to another copy; over a delay it is the drag over the age"),
        base::field("tank", &Options::tank_j, base::Quantity{base::energy_kind, 0.0, 10.0},
                    "most energy that a spring may keep of what the body's drag has dissipated, "
                    "and what it begins with"));
}

/// Couples the copies of the body by springs to the last received places of the other copies
/// (virtual coupling of copies: Lee and Huang 2010, Sankaranarayanan and Hannaford 2008). A spring
/// is stretched to a new place only as far as the energy in its tank allows (passive set-position
/// modulation). The tank is filled by the energy that this body's drag dissipates. The coupling is
/// soft, and passive for any network and any number of peers. If the scene's body has no drag,
/// there is no coupling. docs/design/algorithms.md has the equations.
class Couple {
public:
    /// The energy that the algorithm may bring into a hand at an Omni.
    static constexpr auto energy_limits = energy_at_an_omni(0.7);

    Couple() : Couple(CoupleOptions{}) {}
    explicit Couple(const CoupleOptions& options) : options_{options} {}

    /// Allocates the memory for this number of other peers.
    void prepare(std::size_t others);
    void hear(const ReceivedState& received);
    [[nodiscard]] Outcome tick(scene::World& world, const Situation& situation);
    void forget(std::size_t of = 0) { springs_[of].sent_at.reset(); }

    [[nodiscard]] const CoupleOptions& options() const { return options_; }

    /// The spring to the copy of one of the others.
    struct Spring {
        std::optional<base::TimePoint> sent_at; // send time of the newest message, own clock
        RecentAge ages;
        double stiffness_n_per_m = 0.0;
        glm::dvec3 stretch{0.0}; // from this body to the spring's end
        double tank_j = 0.0;
        glm::dvec3 force{0.0}; // force in the present tick

        [[nodiscard]] double stored_j() const;
    };
    [[nodiscard]] const std::vector<Spring>& springs() const { return springs_; }

private:
    void draw(Spring& spring, const Remote* owner, const Situation& situation,
              const scene::World& world);
    void settle_accounts(const glm::dvec3& moved, double drag, double tick_s);

    CoupleOptions options_;
    std::vector<Spring> springs_;
    AtRest at_rest_;
};

} // namespace hapnet::peer

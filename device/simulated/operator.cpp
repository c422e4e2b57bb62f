// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "device/simulated/operator.hpp"

#include "proto/base/ensure.hpp"
#include "proto/base/latin_hypercube.hpp"

#include <algorithm>
#include <spdlog/fmt/fmt.h>

namespace hapnet::device {

namespace {

using namespace base::literals;

Operator person(std::string_view name, const HandImpedance& hand)
{
    return {.name = std::string{name}, .hand = hand};
}

Operator lifelike(std::string_view name)
{
    Operator result = person(name, {});
    result.wander.amplitude_m = 2.5e-3;
    result.tremor.amplitude_m = 1.5e-4;
    result.force_noise = 3_percent;
    result.reflex.gain = 0.2;
    return result;
}

} // namespace

base::Result<Operator> operator_named(std::string_view name)
{
    const auto& [relaxed, nominal, firm, lively] = operator_names;
    if (name == relaxed) return person(name, {0.15, 3.0, 100.0});
    if (name == nominal) return person(name, {});
    if (name == firm) return person(name, {0.25, 10.0, 500.0});
    if (name == lively) return lifelike(name);
    return base::fail(
        fmt::format("'{}' is not an operator: {}", name, base::suggestion(name, operator_names)));
}

Operator varied(const Operator& person, base::Seed seed, std::uint32_t index, std::uint32_t of)
{
    base::ensure(index < of);
    Operator result = person;
    result.name = fmt::format("{} {}/{}", person.name, index + 1, of);
    const auto factor = [&](std::string_view parameter) {
        constexpr double spread = 0.3;
        const auto stream = seed.stream(fmt::format("operator/{}", parameter));
        const double place = base::latin_places(stream, of)[index];
        return 1.0 + spread * (2.0 * place / of - 1.0);
    };
    const auto vary = [&](double& value, std::string_view parameter) {
        value *= factor(parameter);
    };
    const auto vary_time = [&](base::Duration& value, std::string_view parameter) {
        value = base::from_seconds(base::to_seconds(value) * factor(parameter));
    };
    vary(result.hand.mass_kg, "mass");
    vary(result.hand.damping_ns_per_m, "damping");
    vary(result.hand.stiffness_n_per_m, "stiffness");
    vary(result.wander.amplitude_m, "wander");
    vary(result.tremor.amplitude_m, "tremor");
    double noise = result.force_noise.fraction();
    vary(noise, "force-noise");
    result.force_noise = base::Probability::from_fraction(std::min(noise, 1.0)).value();
    vary(result.reflex.gain, "reflex/gain");
    vary_time(result.reflex.delay, "reflex/delay");
    vary(result.intent.gain_m_per_ns, "will/gain");
    vary_time(result.intent.delay, "will/delay");
    vary(result.search.speed_m_per_s, "search/speed");
    return result;
}

} // namespace hapnet::device

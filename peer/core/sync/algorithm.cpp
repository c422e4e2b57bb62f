// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "peer/core/sync/algorithm.hpp"

#include "proto/base/ensure.hpp"
#include "proto/base/text.hpp"

#include <algorithm>
#include <array>
#include <spdlog/fmt/fmt.h>
#include <type_traits>

namespace hapnet::peer {

namespace {

template <typename... Kinds>
Algorithm algorithm_at(std::size_t index, base::Tag<std::variant<Kinds...>> /*kinds*/)
{
    using Make = Algorithm (*)();
    constexpr std::array<Make, sizeof...(Kinds)> all{[]() -> Algorithm { return Kinds{}; }...};
    return all.at(index)();
}

} // namespace

base::Result<Algorithm> algorithm_named(std::string_view name)
{
    const auto found = std::ranges::find(algorithm_names, name);
    if (found != algorithm_names.end()) {
        return algorithm_at(static_cast<std::size_t>(found - algorithm_names.begin()),
                            base::Tag<Algorithm>{});
    }
    if (name == base::described_name<SharedObjectOptions>) return SharedObject{};
    return base::fail(
        fmt::format("unknown algorithm '{}': {}", name, base::suggestion(name, algorithm_names)));
}

std::string_view name_of(const Algorithm& algorithm)
{
    const auto name = [](const auto& one) -> std::string_view {
        return base::described_name<std::remove_cvref_t<decltype(one.options())>>;
    };
    return std::visit(name, algorithm);
}

Stale stale_of(const Algorithm& algorithm)
{
    const auto stale = [](const auto& one) {
        if constexpr (requires { one.options().stale; }) {
            return one.options().stale;
        } else if constexpr (requires { one.options().base.stale; }) {
            return one.options().base.stale;
        } else {
            return Stale::drop;
        }
    };
    return std::visit(stale, algorithm);
}

void prepare(Algorithm& algorithm, std::size_t others, const scene::World& world)
{
    base::ensure(check_hands_of(algorithm, world.frozen().hands).has_value());
    const auto tell = [&](auto& one) {
        if constexpr (requires { one.prepare(others, world); }) {
            one.prepare(others, world);
        } else if constexpr (requires { one.prepare(others); }) {
            one.prepare(others);
        }
    };
    std::visit(tell, algorithm);
}

bool has_hands_of_others(const Algorithm& algorithm)
{
    return std::holds_alternative<RemoteProxy>(algorithm) ||
           std::holds_alternative<Lag>(algorithm) || std::holds_alternative<Rollback>(algorithm);
}

bool plays_with_many(const Algorithm& algorithm)
{
    if (const auto* own = std::get_if<SharedObject>(&algorithm)) return own->plays_with_many();
    return !std::holds_alternative<DeadReckoning>(algorithm) &&
           !std::holds_alternative<EstimatorPredictor>(algorithm);
}

bool is_loaded(const Algorithm& algorithm)
{
    const auto* const own = std::get_if<SharedObject>(&algorithm);
    return own == nullptr || own->is_loaded();
}

base::Result<void> check_bodies_of(const Algorithm& algorithm, std::span<const SharedBody> bodies)
{
    if (is_one_without_turning(bodies) || std::holds_alternative<RemoteProxy>(algorithm)) return {};
    const auto* const base = std::get_if<BaseAlgorithm>(&algorithm);
    if (base == nullptr) {
        return base::fail(fmt::format("'{}' is for one body that does not turn: use base or "
                                      "remote-proxy, or a scene with one "
                                      "movable body that has turning = \"locked\"",
                                      name_of(algorithm)));
    }
    // The options without those that apply to these bodies. They are compared with the defaults
    // below.
    BaseOptions rest = base->options();
    rest.stale = {};
    rest.let_go_after = {};
    rest.settle_after = BaseOptions{}.settle_after;
    rest.settle_within = BaseOptions{}.settle_within;
    if (rest == BaseOptions{}) return {};
    return base::fail("bodies that turn, and several, follow the other side as base does by "
                      "default: leave out all of its keys but stale, let_go_after, settle_after "
                      "and settle_within");
}

base::Result<void> check_hands_of(const Algorithm& algorithm, const scene::HandDescription& hands)
{
    const bool computes_late =
        std::holds_alternative<Lag>(algorithm) || std::holds_alternative<Rollback>(algorithm);
    if (!computes_late || hands.friction == 0.0) return {};
    return base::fail(fmt::format("'{}' is for hands without friction: leave friction out of the "
                                  "scene's [hips], or use another algorithm",
                                  algorithm_names.at(algorithm.index())));
}

} // namespace hapnet::peer

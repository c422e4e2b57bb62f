// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "peer/core/sync/algorithm.hpp"

#include "proto/base/text.hpp"

#include <spdlog/fmt/fmt.h>

namespace hapnet::peer {

base::Result<Algorithm> algorithm_named(std::string_view name)
{
    const auto& [plain, dead_reckoning, sep, remote_proxy] = algorithm_names;
    if (name == plain) return BaseAlgorithm{};
    if (name == dead_reckoning) return DeadReckoning{};
    if (name == sep) return EstimatorPredictor{};
    if (name == remote_proxy) return RemoteProxy{};
    return base::fail(
        fmt::format("unknown algorithm '{}': {}", name, base::suggestion(name, algorithm_names)));
}

Stale stale_of(const Algorithm& algorithm)
{
    struct Reader {
        Stale operator()(const BaseAlgorithm& one) const { return one.options().stale; }
        Stale operator()(const DeadReckoning& one) const { return one.options().base.stale; }
        Stale operator()(const EstimatorPredictor& one) const { return one.options().base.stale; }
        Stale operator()(const RemoteProxy& /*one*/) const { return Stale::drop; }
    };
    return std::visit(Reader{}, algorithm);
}

bool plays_with_many(const Algorithm& algorithm)
{
    return std::holds_alternative<BaseAlgorithm>(algorithm) ||
           std::holds_alternative<RemoteProxy>(algorithm);
}

base::Result<void> check_bodies_of(const Algorithm& algorithm, std::span<const SharedBody> bodies)
{
    if (is_one_without_turning(bodies)) return {};
    const auto* const base = std::get_if<BaseAlgorithm>(&algorithm);
    if (base == nullptr) {
        return base::fail(fmt::format(
            "'{}' is for one body that does not turn: use base, or a scene with one movable body "
            "that has turning = \"locked\"",
            algorithm_names.at(algorithm.index())));
    }
    BaseOptions rest = base->options(); // but for what these bodies have, too
    rest.stale = {};
    rest.let_go_after = {};
    rest.settle_after = BaseOptions{}.settle_after;
    rest.settle_within = BaseOptions{}.settle_within;
    if (rest == BaseOptions{}) return {};
    return base::fail("bodies that turn, and several, follow the other side as base does by "
                      "default: leave out all of its keys but stale, let_go_after, settle_after "
                      "and settle_within");
}

} // namespace hapnet::peer

// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "peer/core/sync/algorithm.hpp"

#include "proto/base/text.hpp"

#include <spdlog/fmt/fmt.h>

namespace hapnet::peer {

base::Result<Algorithm> algorithm_named(std::string_view name)
{
    const auto& [plain, dead_reckoning, sep] = algorithm_names;
    if (name == plain) return BaseAlgorithm{};
    if (name == dead_reckoning) return DeadReckoning{};
    if (name == sep) return EstimatorPredictor{};
    return base::fail(
        fmt::format("unknown algorithm '{}': {}", name, base::suggestion(name, algorithm_names)));
}

const BaseOptions& base_options(const Algorithm& algorithm)
{
    struct Reader {
        const BaseOptions& operator()(const BaseAlgorithm& one) const { return one.options(); }
        const BaseOptions& operator()(const DeadReckoning& one) const { return one.options().base; }
        const BaseOptions& operator()(const EstimatorPredictor& one) const
        {
            return one.options().base;
        }
    };
    return std::visit(Reader{}, algorithm);
}

} // namespace hapnet::peer

// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "peer/core/sync/algorithm.hpp"

#include "peer/core/sync/keys.hpp"

#include <spdlog/fmt/fmt.h>

namespace hapnet::peer {

base::Result<Algorithm> algorithm_named(std::string_view name)
{
    if (name == Keys<BaseAlgorithm>::name) return BaseAlgorithm{};
    if (name == Keys<DeadReckoning>::name) return DeadReckoning{};
    if (name == Keys<EstimatorPredictor>::name) return EstimatorPredictor{};
    return base::fail(fmt::format("'{}' is not an algorithm; known: {}, {}, {}", name,
                                  Keys<BaseAlgorithm>::name, Keys<DeadReckoning>::name,
                                  Keys<EstimatorPredictor>::name));
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

// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "peer/core/sync/algorithm.hpp"

#include <spdlog/fmt/fmt.h>

namespace hapnet::peer {

base::Result<Algorithm> algorithm_named(std::string_view name)
{
    if (name == "base") return BaseAlgorithm{};
    return base::fail(fmt::format("'{}' is not an algorithm; known: base", name));
}

} // namespace hapnet::peer

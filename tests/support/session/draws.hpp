// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

#include "proto/base/random.hpp"
#include "proto/base/time.hpp"

#include <cstddef>
#include <cstdint>
#include <string_view>

namespace hapnet::test {

/// Draws, each its own, in the order of the calls.
class Draws {
public:
    Draws(base::Seed seed, std::string_view stream) : draw_{seed.stream(stream)} {}

    [[nodiscard]] double share() { return draw_.uniform(next_++); }
    [[nodiscard]] bool one_in(std::uint32_t of) { return draw_.below(of, next_++) == 0; }
    [[nodiscard]] std::size_t below(std::uint32_t bound) { return draw_.below(bound, next_++); }
    [[nodiscard]] base::Duration up_to(base::Duration most)
    {
        const double drawn = share();
        return base::from_seconds(drawn * base::to_seconds(most));
    }

private:
    base::RandomStream draw_;
    std::uint64_t next_ = 0;
};

} // namespace hapnet::test

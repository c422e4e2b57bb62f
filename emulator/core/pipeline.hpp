// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

#include "emulator/core/impairment.hpp"
#include "emulator/core/verdict.hpp"

#include <cstdint>
#include <vector>

namespace hapnet::emulator {

/// The impairments of one direction, one after another. The first drop is final; delays add up,
/// and a negative total counts as zero: nothing leaves before it has arrived.
class Pipeline {
public:
    /// Impairments act in the order given; none at all forwards at once.
    explicit Pipeline(std::vector<Impairment> stages = {});

    [[nodiscard]] Verdict on_packet(std::uint64_t number) const;

private:
    std::vector<Impairment> stages_;
};

} // namespace hapnet::emulator

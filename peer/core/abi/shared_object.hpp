// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

#include "peer/core/abi/algorithm.h"
#include "peer/core/sync/energy_at_an_omni.hpp"
#include "peer/core/sync/situation.hpp"
#include "proto/base/describe.hpp"
#include "proto/base/result.hpp"

#include <cstddef>
#include <memory>
#include <string>
#include <vector>

namespace hapnet::peer {

struct SharedObjectOptions {
    std::string file;       // path of the shared object, relative to the working directory
    std::string parameters; // text whose meaning only the algorithm knows

    friend bool operator==(const SharedObjectOptions&, const SharedObjectOptions&) = default;
};

constexpr auto fields_of(base::Tag<SharedObjectOptions> /*struct*/)
{
    return base::fields("shared-object",
                        base::field("file", &SharedObjectOptions::file,
                                    "of the shared object, from the folder that the program is "
                                    "started in"),
                        base::field("parameters", &SharedObjectOptions::parameters,
                                    "text for the algorithm, which alone knows its meaning"));
}

/// The algorithm that a loaded shared object describes. The object stays loaded as long as a copy
/// of this pointer exists.
using Loaded = std::shared_ptr<const hapnet_algorithm>;

/// An algorithm that is not part of the program: a C function of peer/core/abi/algorithm.h does the
/// work. This class only connects the two; peer/shared_object/load.hpp loads the code. Each copy of
/// this object has its own memory.
class SharedObject {
public:
    /// The energy that the algorithm may bring into a hand at an Omni: the limits of base, whatever
    /// it does.
    static constexpr auto energy_limits = energy_at_an_omni(0.46);

    SharedObject() = default;
    explicit SharedObject(const SharedObjectOptions& options) : options_{options} {}

    /// Returns a copy of this algorithm that runs the loaded code. The error says what is wrong
    /// with the code or with the parameters.
    [[nodiscard]] base::Result<SharedObject> with(Loaded loaded) const;

    void hear(const ReceivedState& received);
    /// Plays one tick. Ensures that the algorithm is loaded.
    [[nodiscard]] Outcome tick(scene::World& world, const Situation& situation);
    void forget(std::size_t other);

    [[nodiscard]] const SharedObjectOptions& options() const { return options_; }
    [[nodiscard]] bool is_loaded() const { return loaded_ != nullptr; }
    /// True if the algorithm can play with more than one other peer. Assumed until it is loaded.
    [[nodiscard]] bool plays_with_many() const { return !loaded_ || loaded_->plays_with_many != 0; }

private:
    SharedObjectOptions options_;
    Loaded loaded_;
    std::vector<std::max_align_t> memory_; // memory of the loaded algorithm
};

} // namespace hapnet::peer

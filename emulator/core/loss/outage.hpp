// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

#include "emulator/core/loss/theory.hpp"
#include "emulator/core/packet.hpp"
#include "proto/base/random.hpp"
#include "proto/base/result.hpp"
#include "proto/base/shared_vector.hpp"
#include "proto/base/time.hpp"

#include <cstddef>
#include <vector>

namespace hapnet::emulator {

/// A time in which everything is lost: from <= t < to, since the run began. from < to.
struct Window {
    base::Duration from{};
    base::Duration to{};

    friend bool operator==(const Window&, const Window&) = default;
};

/// Windows of total loss, ascending and apart from each other.
struct Outage {
    base::SharedVector<Window> windows;

    static constexpr DropCause cause = DropCause::outage;
    static constexpr bool is_in_time = true;
    class Model;

    [[nodiscard]] base::Result<void> validate() const;
    [[nodiscard]] LossTheory theory(const Arrivals&) const;
    [[nodiscard]] std::vector<LossProperty> properties(const RunFacts&) const;

    friend bool operator==(const Outage&, const Outage&) = default;
};

/// Notation: [["10s", "12s"], ["20s", "21s"]]
struct WindowList {
    void read(const base::Node& node, std::vector<Window>& target, base::Reading& reading) const;
    [[nodiscard]] std::string print(const std::vector<Window>& value) const;
    [[nodiscard]] std::string describe() const
    {
        return "a list of times from and to, such as [[\"10s\", \"12s\"]]";
    }
};
constexpr auto fields_of(base::Tag<Outage>)
{
    return base::fields("outage",
                        base::field("windows", &Outage::windows, base::InShared<WindowList>{},
                                    "times during which everything is lost")
                            .required());
}

/// Keeps its place among the windows.
class Outage::Model {
public:
    Model(const Outage& law, const base::RandomStream&) : law_{law} {}

    [[nodiscard]] bool on_packet(const Packet& packet, const base::RandomStream&);
    void change(const Outage& law, const base::RandomStream&);

private:
    Outage law_;
    std::size_t next_ = 0; // index of the first window that is not over
};

} // namespace hapnet::emulator

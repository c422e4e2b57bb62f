// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

#include "emulator/core/loss/theory.hpp"
#include "emulator/core/packet.hpp"
#include "proto/base/random.hpp"
#include "proto/base/result.hpp"
#include "proto/base/shared_vector.hpp"

#include <string>
#include <string_view>
#include <vector>

namespace hapnet::emulator {

/// A pattern that repeats. true: the datagram is lost. Not empty.
struct PatternLoss {
    base::SharedVector<bool> pattern;

    static constexpr DropCause cause = DropCause::pattern_loss;
    static constexpr bool is_in_time = false;
    class Model;

    [[nodiscard]] base::Result<void> validate() const;
    [[nodiscard]] LossTheory theory(const Arrivals&) const;
    [[nodiscard]] std::vector<LossProperty> properties(const RunFacts&) const;

    friend bool operator==(const PatternLoss&, const PatternLoss&) = default;
};

/// Reads a pattern. "0010": of every four datagrams the third is lost. At most 10^6 digits.
[[nodiscard]] base::Result<std::vector<bool>> parse_pattern(std::string_view text);
[[nodiscard]] std::string to_text(const std::vector<bool>& pattern);

struct PatternDigits {
    void read(const base::Node& node, std::vector<bool>& target, base::Reading& reading) const;
    [[nodiscard]] std::string print(const std::vector<bool>& value) const
    {
        return base::quoted(to_text(value));
    }
    [[nodiscard]] std::string describe() const
    {
        return "a text of 0 (passes) and 1 (lost), such as \"0010\"";
    }
};
constexpr auto fields_of(base::Tag<PatternLoss>)
{
    return base::fields("pattern", base::field("pattern", &PatternLoss::pattern,
                                               base::InShared<PatternDigits>{},
                                               "0 (passes) and 1 (lost), repeated")
                                       .required());
}

class PatternLoss::Model {
public:
    Model(const PatternLoss& law, const base::RandomStream& stream) { change(law, stream); }

    [[nodiscard]] bool on_packet(const Packet& packet, const base::RandomStream&) const
    {
        return law_.pattern[packet.number % law_.pattern.size()];
    }
    void change(const PatternLoss& law, const base::RandomStream&);

private:
    PatternLoss law_;
};

} // namespace hapnet::emulator

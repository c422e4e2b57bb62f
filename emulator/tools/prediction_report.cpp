// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "emulator/tools/prediction_report.hpp"

#include "emulator/tools/describe.hpp"

namespace hapnet::emulator::tools {

std::vector<std::string> DirectionForecast::theory() const
{
    return describe(*conditions, *stream);
}

std::vector<std::string> DirectionForecast::warnings() const
{
    return tools::warnings(*conditions, *stream, *of);
}

std::string DirectionForecast::why_unsettled() const
{
    return tools::why_unsettled(*conditions, *stream, *of, has_timeline);
}

std::optional<Precision> DirectionForecast::precision() const
{
    return has_timeline ? std::nullopt : of->precision;
}

base::Entries<std::uint64_t> DirectionForecast::dropped() const
{
    base::Entries<std::uint64_t> entries;
    for (const DropCause cause : drop_causes) {
        const auto count = of->statistics.dropped[cause];
        if (count > 0) entries.emplace_back(to_text(cause), count);
    }
    return entries;
}

double DirectionForecast::reordered_share() const
{
    const auto departures = of->statistics.delivered - of->statistics.duplicated;
    if (departures == 0) return 0.0;
    return static_cast<double>(of->measured.reordered.count) / static_cast<double>(departures);
}

} // namespace hapnet::emulator::tools

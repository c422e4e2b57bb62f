// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "emulator/tools/learn/ping.hpp"

#include <algorithm>
#include <charconv>
#include <chrono>
#include <cmath>
#include <cstdint>
#include <spdlog/fmt/fmt.h>
#include <utility>

namespace hapnet::emulator::tools {

namespace {

constexpr std::string_view digits = "0123456789";
constexpr double time_ms_max = 1e9;
constexpr std::string_view nothing_answered =
    "nothing answered: no line has a time, such as time=20.5 ms";

/// A number at the beginning of a text, with a decimal point or comma, and its length.
struct FoundNumber {
    double value = 0.0;
    std::size_t length = 0;
};
std::optional<FoundNumber> number_at(std::string_view text)
{
    auto length = std::min(text.find_first_not_of(digits), text.size());
    if (length == 0) return std::nullopt;
    const bool has_decimals = length + 1 < text.size() &&
                              (text[length] == '.' || text[length] == ',') &&
                              digits.find(text[length + 1]) != std::string_view::npos;
    if (has_decimals) {
        const auto mark = length;
        length = std::min(text.find_first_not_of(digits, mark + 1), text.size());
        std::string plain{text.substr(0, length)};
        plain[mark] = '.';
        double value = 0.0;
        const auto [end, error] = std::from_chars(plain.data(), plain.data() + length, value);
        if (error != std::errc{}) return std::nullopt;
        return FoundNumber{value, length};
    }
    double value = 0.0;
    const auto [end, error] = std::from_chars(text.data(), text.data() + length, value);
    if (error != std::errc{}) return std::nullopt;
    return FoundNumber{value, length};
}

/// A pair such as "ttl=58" or "time<1". The word before the sign may be in any language.
struct NamedNumber {
    std::string key; // ASCII letters in lower case
    double number = 0.0;
    bool is_below = false;
    bool has_unit = false; // a letter follows the number

    [[nodiscard]] double middle() const { return is_below ? number / 2.0 : number; }
};

/// Returns all pairs of a line, in their order.
std::vector<NamedNumber> pairs_in(std::string_view line)
{
    constexpr std::size_t most = 8;
    std::vector<NamedNumber> pairs;
    for (auto sign = line.find_first_of("=<");
         sign != std::string_view::npos && pairs.size() < most;
         sign = line.find_first_of("=<", sign + 1)) {
        const auto behind = base::trimmed(line.substr(sign + 1));
        const auto number = number_at(behind);
        const auto front = base::trimmed(line.substr(0, sign));
        const auto word = front.substr(front.find_last_of(" \t") + 1);
        if (!number || word.empty()) continue;
        const auto unit = base::trimmed(behind.substr(number->length));
        const bool has_unit =
            unit.starts_with('m') || (!unit.empty() && static_cast<unsigned char>(unit[0]) > 0x7f);
        NamedNumber pair{"", number->value, line[sign] == '<', has_unit};
        for (const char c : word) {
            pair.key += c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c;
        }
        pairs.push_back(std::move(pair));
    }
    return pairs;
}

bool is_time_to_live(const NamedNumber& pair) { return pair.key == "ttl" || pair.key == "hlim"; }
bool is_sequence(const NamedNumber& pair) { return pair.key.find("seq") != std::string::npos; }

/// The contents of one line: an answer has its time, and a question without an answer has only its
/// number.
struct Told {
    std::optional<double> sequence{};
    std::optional<double> time_ms{};
};

/// Reads a line of iputils, BusyBox, BSD or macOS: `icmp_seq=1 ttl=58 time=19.0 ms`, in which the
/// number is before the time to live, and the time is last.
Told told_with_number(std::string_view line)
{
    const auto pairs = pairs_in(line);
    const auto life = std::ranges::find_if(pairs, is_time_to_live);
    auto number = std::ranges::find_if(pairs, is_sequence);
    const bool has_time_last = life != pairs.end() && life + 1 != pairs.end();
    if (number == pairs.end() && has_time_last && life != pairs.begin()) number = life - 1;
    if (number == pairs.end()) return {};
    Told told{.sequence = number->number};
    if (number + 1 != pairs.end() && !is_time_to_live(pairs.back())) {
        told.time_ms = pairs.back().middle();
    }
    return told;
}

/// Returns the time in a line of Windows: `bytes=32 time=25ms TTL=53`; in IPv6 `time=25ms` alone.
std::optional<double> time_without_number(std::string_view line)
{
    const auto pairs = pairs_in(line);
    if (pairs.size() == 1 && pairs.front().has_unit) return pairs.front().middle();
    if (pairs.size() < 2 || !is_time_to_live(pairs.back())) return std::nullopt;
    return pairs[pairs.size() - 2].middle();
}

/// A line of fping: `[1585061216.8] 192.0.2.1 : [0], 84 bytes, 20.59 ms (20.59 avg, 0% loss)`.
struct FpingLine {
    std::string_view host;
    std::string_view rest; // text behind " : "
};
std::optional<FpingLine> fping_line(std::string_view line)
{
    if (line.starts_with('[')) {
        const auto end = line.find("] ");
        if (end == std::string_view::npos) return std::nullopt;
        line = base::trimmed(line.substr(end + 2));
    }
    const auto colon = line.find(" : ");
    if (colon == std::string_view::npos) return std::nullopt;
    const auto host = base::trimmed(line.substr(0, colon));
    if (host.empty() || host.find_first_of(" =") != std::string_view::npos) return std::nullopt;
    return FpingLine{host, base::trimmed(line.substr(colon + 3))};
}

/// Reads `[0], 84 bytes, 20.59 ms (...)` or `[1], timed out (...)`.
Told told_by_fping(std::string_view rest)
{
    if (!rest.starts_with('[')) return {};
    const auto sequence = number_at(rest.substr(1));
    if (!sequence || !rest.substr(1 + sequence->length).starts_with("], ")) return {};
    Told told{.sequence = sequence->value};
    const auto unit = rest.find(" ms");
    if (unit == std::string_view::npos) return told;
    const auto space = rest.find_last_of(' ', unit - 1);
    if (space == std::string_view::npos) return told;
    if (const auto time = number_at(rest.substr(space + 1))) told.time_ms = time->value;
    return told;
}

/// Reads `15.0 - 14.6 14.6 -`: all answers of a host, as fping -C prints them at its end.
std::optional<std::vector<std::optional<double>>> told_in_one_line(std::string_view rest)
{
    std::vector<std::optional<double>> times;
    while (!rest.empty()) {
        const auto word = rest.substr(0, rest.find(' '));
        const auto number = number_at(word);
        if (word != "-" && (!number || number->length != word.size())) return std::nullopt;
        times.push_back(word == "-" ? std::nullopt : std::optional{number->value});
        rest = base::trimmed(rest.substr(word.size()));
    }
    if (times.empty()) return std::nullopt;
    return times;
}

/// Returns the seconds at the beginning of a line, as `ping -D` and `fping -D` write them:
/// "[1585061216.814108] ".
std::optional<double> stamp_of(std::string_view line)
{
    if (!line.starts_with('[')) return std::nullopt;
    const auto number = number_at(line.substr(1));
    if (!number || !line.substr(1 + number->length).starts_with("] ")) return std::nullopt;
    return number->value;
}

/// Collects answers by their numbers.
class NumberedAnswers {
public:
    /// `wraps_at`: all numbers are below it; after the last one they begin again at 0.
    explicit NumberedAnswers(std::uint64_t wraps_at) : wraps_at_{wraps_at} {}

    [[nodiscard]] base::Result<void> add(const Told& told, std::optional<double> stamp)
    {
        if (*told.sequence != std::floor(*told.sequence) ||
            *told.sequence >= static_cast<double>(wraps_at_)) {
            return base::fail(fmt::format(
                "the number of an answer must be a whole number from 0 to {}", wraps_at_ - 1));
        }
        if (told.time_ms && *told.time_ms > time_ms_max) {
            return base::fail("a time must be from 0 to 10^9 ms");
        }
        auto sequence = static_cast<std::uint64_t>(*told.sequence);
        sequence += newest_ / wraps_at_ * wraps_at_;
        if (sequence + wraps_at_ / 2 < newest_) sequence += wraps_at_;
        if (sequence >= trace_rows_max) return base::fail(std::string{too_many_values});
        if (sequence > newest_ + missing_max) {
            return base::fail(fmt::format("{} numbers are missing before it", sequence - newest_));
        }
        if (sequence >= way_.lost.size()) {
            way_.delays.resize(sequence + 1);
            way_.lost.resize(sequence + 1, true);
        }
        has_zero_ = has_zero_ || sequence == 0;
        if (stamp) add_stamp(sequence, *stamp);
        if (!told.time_ms) return {};
        const bool is_copy = !way_.lost[sequence];
        if (is_copy) return {};
        if (answers_ > 0 && sequence < newest_) ++way_.reordered;
        newest_ = std::max(newest_, sequence);
        way_.delays[sequence] = base::Duration{std::llround(1e6 * *told.time_ms)};
        way_.lost[sequence] = false;
        ++answers_;
        return {};
    }

    void set_transmitted(std::uint64_t count, double duration_ms)
    {
        transmitted_ = count;
        duration_ms_ = duration_ms;
    }

    /// `first`: the number of the first question, if the text contains it.
    [[nodiscard]] base::Result<Measurement> finished(std::optional<std::uint64_t> first)
    {
        if (answers_ == 0) {
            return base::fail(std::string{nothing_answered});
        }
        const bool begins_at_one = first.value_or(1) == 1 && !has_zero_;
        if (begins_at_one && !way_.lost.empty()) {
            way_.delays.erase(way_.delays.begin());
            way_.lost.erase(way_.lost.begin());
        }
        if (transmitted_ > way_.lost.size() && transmitted_ <= trace_rows_max) {
            way_.delays.resize(transmitted_);
            way_.lost.resize(transmitted_, true);
        }
        set_spacing();
        return Measurement{.round_trip = std::move(way_)};
    }

private:
    void add_stamp(std::uint64_t sequence, double stamp)
    {
        if (!first_stamp_) first_stamp_ = {sequence, stamp};
        if (!last_stamp_ || sequence > last_stamp_->first) last_stamp_ = {sequence, stamp};
    }

    void set_spacing()
    {
        double spacing_ns = 0.0;
        if (duration_ms_ > 0.0 && transmitted_ > 1) {
            spacing_ns = 1e6 * duration_ms_ / static_cast<double>(transmitted_ - 1);
        } else if (last_stamp_ && last_stamp_->first > first_stamp_->first) {
            const auto steps = static_cast<double>(last_stamp_->first - first_stamp_->first);
            spacing_ns = 1e9 * (last_stamp_->second - first_stamp_->second) / steps;
        }
        if (spacing_ns >= 1.0 && spacing_ns < 1e15) {
            way_.spacing = base::Duration{std::llround(spacing_ns)};
        }
    }

    using Stamp = std::pair<std::uint64_t, double>; // sequence number and time in s
    static constexpr std::uint64_t missing_max = 1'000'000;

    std::uint64_t wraps_at_;
    MeasuredWay way_;
    std::size_t answers_ = 0;
    std::uint64_t newest_ = 0;
    bool has_zero_ = false;
    std::uint64_t transmitted_ = 0;
    double duration_ms_ = 0.0;
    std::optional<Stamp> first_stamp_;
    std::optional<Stamp> last_stamp_;
};

/// True for a line such as "--- example.org ping statistics ---".
bool is_above_summary(std::string_view line)
{
    return line.size() > 4 && line.starts_with("--") && line.ends_with("--");
}

/// Reads a line such as "4 packets transmitted, 3 received, 25% packet loss, time 3003ms". In every
/// language the first number is that of the packets, and only the time may follow the share that
/// was lost.
void add_summary(std::string_view line, NumberedAnswers& answers)
{
    std::optional<double> transmitted;
    double last = 0.0;
    bool is_share_last = true;
    for (std::size_t i = 0; i < line.size();) {
        const auto number = number_at(line.substr(i));
        if (!number) {
            ++i;
            continue;
        }
        const auto behind = base::trimmed(line.substr(i + number->length));
        is_share_last = behind.starts_with('%') || (i > 0 && line[i - 1] == '%');
        last = number->value;
        if (!transmitted) transmitted = number->value;
        i += number->length;
    }
    if (!transmitted || *transmitted > 1e9) return;
    const bool has_time = !is_share_last && line.find('%') != std::string_view::npos;
    answers.set_transmitted(static_cast<std::uint64_t>(*transmitted), has_time ? last : 0.0);
}

/// Returns the number of the first question, according to the first line of a ping: iputils counts
/// from 1, "PING x (192.0.2.1) 56(84) bytes of data."; others count from 0, "PING x (192.0.2.1): 56
/// data bytes".
std::optional<std::uint64_t> first_number(std::string_view header)
{
    if (!header.starts_with("PING")) return std::nullopt;
    const auto colon = header.find(": ");
    const bool is_other = header.starts_with("PING6(") ||
                          (colon != std::string_view::npos && number_at(header.substr(colon + 2)));
    return is_other ? 0 : 1;
}

base::Result<Measurement> read_numbered(std::string_view text)
{
    constexpr std::uint64_t echo_numbers = 65'536; // sequence numbers have 16 bits
    NumberedAnswers answers{echo_numbers};
    base::LineReader lines{text};
    std::optional<std::uint64_t> first;
    bool is_summary_next = false;
    for (auto line = lines.next(); line; line = lines.next()) {
        if (!first) first = first_number(*line);
        if (is_summary_next || line->find(" packets transmitted") != std::string_view::npos) {
            add_summary(*line, answers);
            is_summary_next = false;
            continue;
        }
        is_summary_next = is_above_summary(*line);
        auto told = told_with_number(*line);
        constexpr std::string_view unanswered = "icmp_seq "; // macOS: "timeout for icmp_seq 3"
        const auto place = line->find(unanswered);
        if (!told.sequence && place != std::string_view::npos) {
            const auto number = number_at(line->substr(place + unanswered.size()));
            if (number) told.sequence = number->value;
        }
        if (!told.sequence) continue;
        const auto added = answers.add(told, stamp_of(*line));
        if (!added) return lines.fail(added.error().message);
    }
    auto measurement = answers.finished(first);
    if (!measurement) return lines.fail(measurement.error().message);
    return measurement;
}

base::Result<Measurement> read_fping(std::string_view text)
{
    NumberedAnswers answers{std::uint64_t{1} << 32U};
    MeasuredWay in_one_line;
    bool has_numbers = false;
    std::string host;
    base::LineReader lines{text};
    for (auto line = lines.next(); line; line = lines.next()) {
        const auto found = fping_line(*line);
        if (!found) continue;
        const auto told = told_by_fping(found->rest);
        const auto all = told.sequence ? std::nullopt : told_in_one_line(found->rest);
        if (!told.sequence && !all) continue;
        if (!host.empty() && host != found->host) {
            return lines.fail(fmt::format("it has answers of two hosts, {} and {}: keep the lines "
                                          "of one, for example with grep",
                                          base::shortened(host), base::shortened(found->host)));
        }
        host = found->host;
        if (told.sequence) {
            has_numbers = true;
            const auto added = answers.add(told, stamp_of(*line));
            if (!added) return lines.fail(added.error().message);
            continue;
        }
        if (in_one_line.lost.size() + all->size() > trace_rows_max) {
            return lines.fail(too_many_values);
        }
        for (const auto& time : *all) {
            if (time && *time > time_ms_max) return lines.fail("a time must be from 0 to 10^9 ms");
            in_one_line.add(base::Duration{std::llround(1e6 * time.value_or(0.0))}, !time);
        }
    }
    const bool has_answer = std::ranges::find(in_one_line.lost, false) != in_one_line.lost.end();
    if (!has_numbers && has_answer) return Measurement{.round_trip = std::move(in_one_line)};
    auto measurement = answers.finished(0);
    if (!measurement) return lines.fail(measurement.error().message);
    return measurement;
}

/// Reads lines of Windows, which have no numbers. Each line between the line with the host, which
/// ends with a colon, and the next empty line is an answer or a loss. The indented statistics also
/// begin with a line that ends with a colon.
class WindowsAnswers {
public:
    [[nodiscard]] base::Result<void> add(std::string_view whole)
    {
        const auto line = base::trimmed(whole);
        if (line.empty()) {
            place_ = Place::between;
            return {};
        }
        const auto time = time_without_number(line);
        if (!time && line.ends_with(':')) {
            place_ = Place::below_header;
            return {};
        }
        if (place_ == Place::below_header) {
            const bool are_statistics = whole.starts_with(' ') || whole.starts_with('\t') ||
                                        line.find('%') != std::string_view::npos;
            place_ = are_statistics ? Place::statistics : Place::answers;
        } else if (place_ == Place::between && time) {
            place_ = Place::answers;
        }
        if (place_ != Place::answers) return {};
        if (time && *time > time_ms_max) return base::fail("a time must be from 0 to 10^9 ms");
        if (way_.lost.size() == trace_rows_max) return base::fail(std::string{too_many_values});
        way_.add(base::Duration{std::llround(1e6 * time.value_or(0.0))}, !time);
        if (time && line.find('<') != std::string_view::npos) ++below_;
        return {};
    }

    [[nodiscard]] Measurement finished()
    {
        Measurement measurement{.round_trip = std::move(way_)};
        if (below_ > 0) {
            measurement.remarks.push_back(
                fmt::format("{} of the answers took less than 1 ms: taken for 0.5 ms", below_));
        }
        return measurement;
    }

private:
    enum class Place : std::uint8_t { between, below_header, answers, statistics };

    MeasuredWay way_;
    std::size_t below_ = 0; // answers that took less time than their line states
    Place place_ = Place::between;
};

base::Result<Measurement> read_windows(std::string_view text)
{
    WindowsAnswers answers;
    for (std::size_t number = 1; !text.empty(); ++number) {
        const auto line = text.substr(0, text.find('\n'));
        text.remove_prefix(std::min(line.size() + 1, text.size()));
        if (const auto added = answers.add(line); !added) {
            return base::fail(fmt::format("line {}: {}", number, added.error().message));
        }
    }
    auto measurement = answers.finished();
    if (std::ranges::find(measurement.round_trip->lost, false) ==
        measurement.round_trip->lost.end()) {
        return base::fail(fmt::format("line 1: {}", nothing_answered));
    }
    return measurement;
}

/// The groups of programs with similar lines.
enum class Dialect : std::uint8_t { numbered, windows, fping };

std::optional<Dialect> dialect_of_line(std::string_view line)
{
    if (const auto found = fping_line(line)) {
        if (told_by_fping(found->rest).sequence || told_in_one_line(found->rest)) {
            return Dialect::fping;
        }
    }
    if (told_with_number(line).time_ms) return Dialect::numbered;
    if (time_without_number(line)) return Dialect::windows;
    return std::nullopt;
}

/// Returns the dialect of the first line that has one, if it comes soon: a table may have millions
/// of lines.
std::optional<Dialect> dialect_of(std::string_view text)
{
    constexpr std::size_t lines_max = 10'000;
    base::LineReader lines{text};
    for (auto line = lines.next(); line && lines.number() <= lines_max; line = lines.next()) {
        if (const auto dialect = dialect_of_line(*line)) return dialect;
    }
    return std::nullopt;
}

} // namespace

bool is_ping(std::string_view text)
{
    const auto first = base::LineReader{text}.next().value_or("");
    return first.starts_with("PING ") || dialect_of(text).has_value();
}

base::Result<Measurement> read_ping(std::string_view text)
{
    switch (dialect_of(text).value_or(Dialect::numbered)) {
    case Dialect::windows: return read_windows(text);
    case Dialect::fping: return read_fping(text);
    case Dialect::numbered: break;
    }
    return read_numbered(text);
}

} // namespace hapnet::emulator::tools

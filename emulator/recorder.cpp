// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "emulator/recorder.hpp"

#include "emulator/core/fates/fates.hpp"
#include "proto/base/version.hpp"
#include "proto/disk/create.hpp"
#include "proto/net/clock.hpp"
#include "proto/net/real_time.hpp"

#include <algorithm>
#include <cerrno>
#include <chrono>
#include <cstring>
#include <filesystem>
#include <iterator>
#include <netinet/in.h>
#include <spdlog/fmt/fmt.h>
#include <system_error>
#include <unistd.h>
#include <utility>

namespace hapnet::emulator {

namespace {

constexpr base::Duration write_every = std::chrono::milliseconds{20};
constexpr std::size_t buffer_bytes = 1 << 18;
/// The greatest number of entries of one queue that are written before those of the other.
constexpr std::size_t batch_max = 4096;
/// The size of the rows that are kept in memory, of all directions together.
constexpr std::size_t waiting_bytes_max = 4 << 20;
/// The limit of the packets held in memory: 20 s of two peers take 24 MB.
constexpr std::size_t held_bytes_max = std::size_t{64} << 20;

[[noreturn]] void refuse(const std::string& what)
{
    throw std::system_error{errno, std::generic_category(), what};
}

/// Opens a file without a name, in the folder of `path` so that there is room for it, or in that of
/// temporary files when that folder cannot have files (/dev).
disk::Descriptor open_nameless(const std::string& path)
{
    const auto temporary = (std::filesystem::temp_directory_path() / "fates").string();
    std::error_code error;
    for (const std::string& beside : {path, temporary}) {
        const auto place = disk::Place::find(beside);
        auto file = place ? disk::create_nameless(*place) : tl::unexpected{place.error()};
        if (file) return *std::move(file);
        error = file.error();
    }
    throw std::system_error{error, fmt::format("cannot write beside {}", path)};
}

} // namespace

UdpAddress udp_address_of(const net::Endpoint& endpoint)
{
    UdpAddress address;
    address.port = endpoint.port();
    address.is_v6 = endpoint.family() == AF_INET6;
    if (address.is_v6) {
        sockaddr_in6 v6{};
        std::memcpy(&v6, endpoint.address(), sizeof v6);
        std::memcpy(address.address.data(), &v6.sin6_addr, sizeof v6.sin6_addr);
    } else {
        sockaddr_in v4{};
        std::memcpy(&v4, endpoint.address(), sizeof v4);
        std::memcpy(address.address.data(), &v4.sin_addr, sizeof v4.sin_addr);
    }
    return address;
}

Recorder::Fates::Fates(const std::string& path, FateColumns its_columns)
    : file{path, "--fates"}, columns{its_columns}, aside{open_nameless(path)}
{
    ways[0].rows.reserve(2 * buffer_bytes);
    ways[0].rows = head_of_fates(columns) + '\n';
}

Recorder::Fates::Way& Recorder::Fates::way_of(const FateEntry& entry)
{
    const std::size_t way =
        2 * std::size_t{entry.path} + (entry.direction == Direction::up ? 0 : 1);
    if (way >= ways.size()) ways.resize(2 * std::size_t{entry.path} + 2);
    return ways[way];
}

/// Writes the fates that wait in a queue, at most `batch_max` of them. Once the file could not be
/// written, they are only counted.
void Recorder::Fates::write(Queue<FateEntry>& queue)
{
    FateEntry entry;
    try {
        for (std::size_t i = 0; i < batch_max && queue.try_dequeue(entry); ++i) {
            ++loss.taken;
            if (!loss.failure) add(entry);
        }
        if (!loss.failure) append_first();
        if (waiting_bytes >= waiting_bytes_max) {
            for (std::size_t way = 1; way < ways.size(); ++way) set_aside(ways[way]);
        }
    } catch (...) {
        loss.fail();
        ways.clear(); // the rows of these ways are in no file
        waiting_bytes = 0;
    }
    loss.note();
}

void Recorder::Fates::add(const FateEntry& entry)
{
    Way& way = way_of(entry);
    const auto before = way.rows.size();
    if (columns != FateColumns{}) {
        if (entry.path >= cells.size()) {
            const std::scoped_lock guard{coming_lock};
            std::move(coming.begin(), coming.end(), std::back_inserter(cells));
            coming.clear();
        }
        way.rows += cells.at(entry.path).begin;
    }
    const RegimeNames* regimes = nullptr;
    if (columns.has_regimes) {
        regimes = &cells[entry.path].regimes[entry.direction == Direction::up ? 0 : 1];
    }
    append_row(way.rows, entry.direction, entry.number, entry.fate, regimes);
    if (&way == ways.data()) {
        ++waiting_first;
        return;
    }
    waiting_bytes += way.rows.size() - before;
    if (way.rows.size() >= buffer_bytes) set_aside(way);
}

/// Writes the rows of the first direction.
void Recorder::Fates::append_first()
{
    file.append(ways[0].rows);
    ways[0].rows.clear();
    loss.kept += std::exchange(waiting_first, 0);
}

/// Writes the waiting fates of a direction to the file without a name.
void Recorder::Fates::set_aside(Way& way)
{
    if (way.rows.empty()) return;
    if (const auto error = disk::write_all(aside.number(), way.rows).error)
        throw std::system_error{error, "cannot write the fates that come last"};
    way.pieces.push_back({aside_bytes, way.rows.size()});
    aside_bytes += way.rows.size();
    waiting_bytes -= way.rows.size();
    way.rows.clear();
}

void Recorder::Fates::copy(const Piece& piece, std::string& buffer)
{
    for (std::size_t done = 0; done < piece.bytes;) {
        buffer.resize(std::min(buffer_bytes, piece.bytes - done));
        const auto count = pread(aside.number(), buffer.data(), buffer.size(),
                                 static_cast<off_t>(piece.begin + done));
        if (count == 0 || (count < 0 && errno != EINTR)) {
            refuse("cannot read the fates that come last");
        }
        if (count < 0) continue;
        file.append({buffer.data(), static_cast<std::size_t>(count)});
        done += static_cast<std::size_t>(count);
    }
}

/// Appends the rows of all directions but the first to the file, one direction after the other.
void Recorder::Fates::join()
{
    std::string buffer;
    for (std::size_t way = 1; way < ways.size(); ++way) {
        for (const Piece& piece : ways[way].pieces) copy(piece, buffer);
        file.append(ways[way].rows);
    }
    file.commit({});
}

/// Completes the file. On a full disk it has the rows of the first direction.
void Recorder::Fates::finish()
{
    try {
        if (!loss.failure) join();
    } catch (...) {
        loss.fail();
    }
    if (!loss.failure) return;
    if (!file.keep()) loss.kept = 0;
    loss.note();
}

Recorder::Capture::Capture(const Files& files)
    : span{files.kept},
      keeper{files.keep_in},
      since_1970{base::from_seconds(net::wall_clock_seconds()) -
                 net::monotonic_now().time_since_epoch()}
{
    if (files.capture) file.emplace(*files.capture, "--pcap");
    if (span) held.emplace(*span, held_bytes_max);
    append_capture_head(section, base::version_line("hapnet-emulator"), files.pairs);
    bytes.reserve(2 * buffer_bytes);
    bytes = section;
}

void Recorder::Capture::write(Queue<Part>& queue, Incomplete& incomplete)
{
    Part part;
    for (std::size_t i = 0; i < batch_max && queue.try_dequeue(part); ++i) {
        take(part, incomplete);
        if (bytes.size() >= buffer_bytes) flush();
    }
    flush();
    loss.note();
}

void Recorder::Capture::flush()
{
    try {
        if (file && !loss.failure) {
            file->append(bytes);
            loss.kept = loss.taken;
        }
    } catch (...) {
        loss.fail();
    }
    bytes.clear();
}

void Recorder::Capture::finish()
{
    if (!file) return;
    try {
        if (!loss.failure) file->commit({});
    } catch (...) {
        loss.fail();
    }
    if (!loss.failure) return;
    if (!file->keep()) loss.kept = 0;
    loss.note();
}

/// Writes the captures of the held packets that were ordered.
void Recorder::Capture::save_ordered()
{
    if (const auto order = keeper.take())
        keeper.save(order->path, section + held->since(order->from));
}

/// Takes a part of a packet. If not all chunks of a packet arrive, it is lost, and the next one
/// begins instead.
void Recorder::Capture::take(const Part& part, Incomplete& incomplete)
{
    auto& [head, payload] = incomplete;
    if (const auto* beginning = std::get_if<CaptureHeader>(&part)) {
        head = *beginning;
        payload.clear();
    } else {
        const auto& chunk = std::get<CaptureChunk>(part);
        payload.insert(payload.end(), chunk.bytes.begin(),
                       chunk.bytes.begin() + static_cast<std::ptrdiff_t>(chunk.count));
    }
    if (!head || payload.size() < head->packet.payload.size()) return;
    append(incomplete);
    head.reset();
}

void Recorder::Capture::append(const Incomplete& complete)
{
    comment.clear();
    const CaptureHeader& head = *complete.head;
    CapturedPacket packet = head.packet;
    if (packet.is_outbound) {
        append_departure_comment(comment, head.late, head.is_copy);
    } else {
        append_arrival_comment(comment, head.fate);
    }
    packet.payload = complete.payload;
    ++loss.taken;
    const std::size_t before = bytes.size();
    append_packet(bytes, packet, since_1970, comment);
    if (held) held->add(packet.at, std::string_view{bytes}.substr(before));
}

Recorder::Recorder(const Files& files) : regimes_{files.regimes}
{
    if (files.fates) fates_ = std::make_unique<Fates>(*files.fates, files.columns);
    if (files.capture || files.kept) capture_ = std::make_unique<Capture>(files);
    for (std::size_t i = 0; i < files.lanes; ++i) {
        lanes_.push_back(std::make_unique<Lane>(fates_ != nullptr, capture_ != nullptr));
    }
    if (fates_ || capture_) thread_ = std::thread{[this] { run(); }};
}

Recorder::~Recorder()
{
    stop_.store(true, std::memory_order_release);
    if (thread_.joinable()) thread_.join();
}

std::uint32_t Recorder::add_path(const std::string& name)
{
    const std::scoped_lock guard{paths_lock_}; // keeps numbers and names in the same order
    if (fates_ && fates_->columns != FateColumns{}) {
        const std::scoped_lock coming_guard{fates_->coming_lock};
        fates_->coming.push_back(
            {row_begin(fates_->columns, name), regimes_ ? regimes_(name) : NamesOfRegimes{}});
    }
    return paths_++;
}

std::uint64_t Recorder::fates_lost() const
{
    std::uint64_t sum = 0;
    for (const auto& lane : lanes_) sum += lane->fates_lost_.load(relaxed);
    if (fates_) sum += fates_->loss.lost.load(relaxed);
    return sum;
}

std::uint64_t Recorder::capture_lost() const
{
    std::uint64_t sum = 0;
    for (const auto& lane : lanes_) sum += lane->packets_lost_.load(relaxed);
    if (capture_) sum += capture_->loss.lost.load(relaxed);
    return sum;
}

std::optional<base::Duration> Recorder::held() const
{
    return capture_ ? capture_->span : std::nullopt;
}

base::Result<std::string> Recorder::keep(const std::string& name, base::TimePoint from)
{
    if (!held()) return base::fail("nothing is held in memory");
    return capture_->keeper.order(name + ".pcapng", from);
}

std::optional<std::string> Recorder::keep_trouble()
{
    return capture_ ? capture_->keeper.trouble() : std::nullopt;
}

Recorder::Lane::Lane(bool has_fates, bool has_capture)
{
    if (has_fates) fates_.emplace(fates_max);
    if (has_capture) packets_.emplace(packets_max);
}

void Recorder::Lane::on_fate(std::uint32_t path, Direction direction, std::uint64_t number,
                             const Fate& fate)
{
    if (!fates_) return;
    if (!fates_->try_enqueue({fate, number, path, direction})) fates_lost_.fetch_add(1, relaxed);
}

void Recorder::Lane::on_arrival(const CapturedPacket& packet, const Fate& fate)
{
    if (packets_) put({.packet = packet, .fate = fate, .late = {}, .is_copy = false});
}

void Recorder::Lane::on_departure(const CapturedPacket& packet, base::Duration late, bool is_copy)
{
    if (packets_) put({.packet = packet, .fate = {}, .late = late, .is_copy = is_copy});
}

void Recorder::Lane::put(const CaptureHeader& header)
{
    bool fits = packets_->try_enqueue(Part{header});
    for (auto rest = header.packet.payload; fits && !rest.empty();) {
        Part part{std::in_place_type<CaptureChunk>};
        auto& chunk = std::get<CaptureChunk>(part);
        chunk.count = std::min(rest.size(), chunk.bytes.size());
        std::copy_n(rest.begin(), chunk.count, chunk.bytes.begin());
        rest = rest.subspan(chunk.count);
        fits = packets_->try_enqueue(std::move(part));
    }
    if (!fits) packets_lost_.fetch_add(1, relaxed);
}

void Recorder::write()
{
    for (const auto& lane : lanes_) {
        if (lane->fates_) fates_->write(*lane->fates_);
        if (lane->packets_) capture_->write(*lane->packets_, lane->incomplete_);
    }
    note_failures();
    if (capture_) capture_->save_ordered();
}

void Recorder::note_failures()
{
    const bool failed = (fates_ && fates_->loss.failure) || (capture_ && capture_->loss.failure);
    if (failed) failed_.store(true, std::memory_order_release);
}

/// Returns the length of the longest queue.
std::size_t Recorder::waiting() const
{
    std::size_t most = 0;
    for (const auto& lane : lanes_) {
        if (lane->fates_) most = std::max(most, lane->fates_->size_approx());
        if (lane->packets_) most = std::max(most, lane->packets_->size_approx());
    }
    return most;
}

/// The thread function: writes what waits, and sleeps. It polls, so that the relay need not wake
/// it.
void Recorder::run()
{
    net::leave_real_time(); // may be inherited from the relay; not for files
    while (!stop_.load(std::memory_order_acquire)) {
        write();
        if (waiting() < batch_max) net::sleep_until(net::monotonic_now() + write_every);
    }
    do {
        write();
    } while (waiting() > 0);
}

void Recorder::finish()
{
    if (!thread_.joinable()) return;
    stop_.store(true, std::memory_order_release);
    thread_.join();
    if (fates_) fates_->finish();
    if (capture_) capture_->finish();
    note_failures();
    if (fates_ && fates_->loss.failure) std::rethrow_exception(fates_->loss.failure);
    if (capture_ && capture_->loss.failure) std::rethrow_exception(capture_->loss.failure);
}

} // namespace hapnet::emulator

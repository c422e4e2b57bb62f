// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

#include "emulator/core/capture/pcapng.hpp"
#include "emulator/core/conditions.hpp"
#include "emulator/core/fate.hpp"
#include "emulator/core/fates/fates.hpp"
#include "emulator/core/profile/regimes.hpp"
#include "proto/base/rolling_bytes.hpp"
#include "proto/base/time.hpp"
#include "proto/disk/descriptor.hpp"
#include "proto/disk/result_file.hpp"
#include "proto/net/endpoint.hpp"
#include "proto/net/keeper.hpp"

#include <array>
#include <atomic>
#include <cstdint>
#include <exception>
#include <functional>
#include <memory>
#include <mutex>
#include <optional>
#include <readerwriterqueue/readerwritercircularbuffer.h>
#include <span>
#include <string>
#include <thread>
#include <variant>
#include <vector>

namespace hapnet::emulator {

/// Returns an endpoint in the form that a capture needs.
[[nodiscard]] UdpAddress udp_address_of(const net::Endpoint& endpoint);

/// Writes the fates and the capture of a run, on a thread of normal priority. The entries of the
/// relay pass through bounded queues, which never make it wait. Entries that do not fit are
/// counted.
class Recorder {
public:
    struct Files {
        std::optional<std::string> fates{};
        std::optional<std::string> capture{};
        std::optional<base::Duration> kept{}; // time for which packets are held in memory
        std::string keep_in{};                // folder for captures of held packets
        std::vector<CaptureNames> pairs{CaptureNames{}}; // pairs of interfaces in the capture
        FateColumns columns{};                           // columns of the file of fates
        /// Returns the regimes of a path, up and down. null: there are no regimes.
        std::function<NamesOfRegimes(const std::string& path)> regimes{};
        std::size_t lanes = 1; // threads that hand over entries
    };

    class Lane;

    /// Opens the files and starts the thread. If there are no files, there is no thread. The
    /// signals that only the calling thread may receive must be blocked already. Throws
    /// std::system_error when a file cannot be written.
    explicit Recorder(const Files& files);
    /// Discards files that were not finished.
    ~Recorder();
    Recorder(const Recorder&) = delete;
    Recorder& operator=(const Recorder&) = delete;

    /// Returns the lane of one of the threads that hand over entries, by its number from 0.
    [[nodiscard]] Lane& lane(std::size_t number = 0) { return *lanes_.at(number); }

    /// Registers a path whose fates will be handed over, and returns its number. Numbers count from
    /// 0 in the order of the calls. The file has the rows of the paths in that order, whichever
    /// lanes they come through. May allocate and lock. Call it from any thread.
    [[nodiscard]] std::uint32_t add_path(const std::string& name);

    /// Return the number of fates, and of packets, that are missing in their files: they found no
    /// room in a queue, or the file could not be written. If the number is above 0, the file is not
    /// complete.
    [[nodiscard]] std::uint64_t fates_lost() const;
    [[nodiscard]] std::uint64_t capture_lost() const;

    /// Returns the time span for which the latest packets are held in memory; nullopt: none are
    /// held.
    [[nodiscard]] std::optional<base::Duration> held() const;
    /// Orders a capture of the packets since `from`, and returns the path of its file. Never waits:
    /// the complete file appears soon after. The error says why there will be no file. Call it from
    /// one thread only.
    [[nodiscard]] base::Result<std::string> keep(const std::string& name, base::TimePoint from);
    /// Returns, once, why an ordered capture could not be written.
    [[nodiscard]] std::optional<std::string> keep_trouble();

    /// True if a file could not be written (a full disk). From then on all further entries for it
    /// are lost.
    [[nodiscard]] bool has_failed() const { return failed_.load(std::memory_order_acquire); }

    /// Writes everything that was handed over and puts the files into their places. Throws the
    /// error of the first file that failed. The part of that file up to the failure is then in its
    /// place, and the other file is complete. Hand over nothing after this call.
    void finish();

private:
    static constexpr auto relaxed = std::memory_order_relaxed;

    struct FateEntry {
        Fate fate;
        std::uint64_t number = 0;
        std::uint32_t path = 0;
        Direction direction = Direction::up;
    };
    /// The beginning of a packet. Its bytes follow in chunks.
    // No defaults: Clang 14 needs them before the class that holds this one is complete.
    struct CaptureHeader {     // NOLINT(cppcoreguidelines-pro-type-member-init)
        CapturedPacket packet; // of its payload only the size is valid
        Fate fate;             // for a packet that arrived
        base::Duration late;   // for a packet that left
        bool is_copy;
    };
    struct CaptureChunk {
        std::array<std::byte, 240> bytes; // most datagrams are one chunk
        std::size_t count;
    };
    using Part = std::variant<CaptureHeader, CaptureChunk>;

    // This is the one of the package's two queues that ThreadSanitizer can analyse. It makes no
    // system call unless a thread waits for it, and no thread does here.
    template <typename T>
    using Queue = moodycamel::BlockingReaderWriterCircularBuffer<T>;

    /// The number of entries that are missing in a file which could not be written to its end.
    struct Loss {
        std::uint64_t taken = 0;            // entries taken out of the queues
        std::uint64_t kept = 0;             // entries written to the file
        std::exception_ptr failure;         // null: no write has failed
        std::atomic<std::uint64_t> lost{0}; // missing entries; other threads read it

        /// Stores the current exception, which is the first one of the file.
        void fail()
        {
            failure = std::current_exception();
            note();
        }
        void note()
        {
            if (failure) lost.store(taken - kept, relaxed);
        }
    };

    /// The rows of each direction, in the order of the paths, whenever they come. The rows of the
    /// first direction go to the file. The rows of the others go in pieces to a file without a
    /// name, until the end.
    struct Fates {
        Fates(const std::string& path, FateColumns columns);

        /// Contents of the rows of a path other than their fates.
        struct Cells {
            std::string begin;
            NamesOfRegimes regimes;
        };

        void write(Queue<FateEntry>& queue);
        void finish();

        struct Piece {
            std::uint64_t begin = 0; // offset in the unnamed file
            std::size_t bytes = 0;
        };
        struct Way {
            std::string rows; // rows that are not written yet
            std::vector<Piece> pieces;
        };
        Way& way_of(const FateEntry& entry);
        void add(const FateEntry& entry);
        void append_first();
        void set_aside(Way& way);
        void copy(const Piece& piece, std::string& buffer);
        void join();

        disk::ResultFile file;
        FateColumns columns;
        disk::Descriptor aside; // the unnamed file, for all directions but the first
        std::uint64_t aside_bytes = 0;
        std::size_t waiting_bytes = 0;   // rows in memory, of all directions but the first
        std::uint64_t waiting_first = 0; // rows of the first direction that are not written yet
        std::vector<Way> ways{2};        // up and down of each path
        std::vector<Cells> cells;        // one for each path
        std::mutex coming_lock;
        std::vector<Cells> coming; // cells of paths that the writer has not seen yet
        Loss loss;                 // counts rows
    };
    /// The chunks of a packet that have come through a lane so far.
    struct Incomplete {
        std::optional<CaptureHeader> head; // header of the packet whose chunks are coming
        std::vector<std::byte> payload;
    };
    struct Capture {
        explicit Capture(const Files& files);

        void write(Queue<Part>& queue, Incomplete& incomplete);
        void take(const Part& part, Incomplete& incomplete);
        void append(const Incomplete& complete);
        void flush();
        void save_ordered();
        void finish();

        std::optional<disk::ResultFile> file; // capture of the whole run
        std::string section;                  // first bytes of every capture
        std::optional<base::Duration> span;
        std::optional<base::RollingBytes> held; // packets of the last `span`; nullopt: none
        net::Keeper keeper;
        base::Duration since_1970; // time from 1970 to time point 0
        std::string bytes;
        std::string comment;
        Loss loss; // counts packets
    };

    void run();
    void write();
    void note_failures();
    [[nodiscard]] std::size_t waiting() const;

    std::function<NamesOfRegimes(const std::string& path)> regimes_;
    std::unique_ptr<Fates> fates_;
    std::unique_ptr<Capture> capture_;
    std::vector<std::unique_ptr<Lane>> lanes_;
    std::mutex paths_lock_;
    std::uint32_t paths_ = 0;
    std::atomic<bool> stop_{false};
    std::atomic<bool> failed_{false};
    std::thread thread_; // last member: the thread uses the others
};

/// The connection of one thread to the files, for that thread alone. Handing over neither allocates
/// nor locks nor calls the system. It does nothing where no file is written.
class Recorder::Lane {
public:
    /// Makes a lane with queues for the files that exist. Recorder::lane() says who may use it.
    Lane(bool has_fates, bool has_capture);

    [[nodiscard]] bool captures() const { return packets_.has_value(); }

    /// Hands over the fate of datagram `number` on that path.
    void on_fate(std::uint32_t path, Direction direction, std::uint64_t number, const Fate& fate);
    /// Hands over a datagram that arrived, and its fate, including the effect of the queues.
    void on_arrival(const CapturedPacket& packet, const Fate& fate);
    /// Hands over a datagram that left `late` after it was due.
    void on_departure(const CapturedPacket& packet, base::Duration late, bool is_copy);

private:
    friend class Recorder;

    void put(const CaptureHeader& header);

    static constexpr std::size_t fates_max = 1 << 16;   // 3 s at 20 000 datagrams/s
    static constexpr std::size_t packets_max = 1 << 17; // 1.6 s at 20 000 datagrams/s
    std::optional<Queue<FateEntry>> fates_;
    std::optional<Queue<Part>> packets_;
    std::atomic<std::uint64_t> fates_lost_{0};
    std::atomic<std::uint64_t> packets_lost_{0};
    Incomplete incomplete_; // used by the writing thread only
};

} // namespace hapnet::emulator

// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

#include "lab/experiment/session_spec.hpp"
#include "proto/base/result.hpp"
#include "proto/disk/descriptor.hpp"

#include <condition_variable>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <mutex>
#include <optional>
#include <set>
#include <span>
#include <string>
#include <string_view>
#include <unordered_map>
#include <vector>

namespace hapnet::lab::runner {

/// The identity of an experiment's folder of results. The folder refuses sessions of another
/// experiment.
struct FolderIdentity {
    std::string kind;
    std::string title;
};

/// The sessions that an experiment has played, in files of JSON lines. Each session is appended as
/// soon as it is over, so that an interrupted run loses none of them. Memory holds only their
/// places in the files. Several threads may use the store; no session is played twice.
class SessionStore {
public:
    /// Reads the stored sessions and locks the file against other runs. Fails when the file belongs
    /// to another experiment, or when another run has it open. Throws std::system_error when it
    /// cannot be written. `program` is the program that plays: sessions of another one are ignored.
    [[nodiscard]] static base::Result<std::unique_ptr<SessionStore>>
    open(const std::string& path, const FolderIdentity& identity, std::string program);
    /// Opens the sessions of all these files read-only. Fails when a file belongs to another
    /// experiment.
    [[nodiscard]] static base::Result<std::unique_ptr<SessionStore>>
    open_all(std::span<const std::string> paths, const FolderIdentity& identity,
             std::string program);
    ~SessionStore() = default;
    SessionStore(const SessionStore&) = delete;
    SessionStore& operator=(const SessionStore&) = delete;

    /// Returns the stored session of a spec, or plays it with `play`. Throws std::system_error when
    /// it cannot be read or stored.
    [[nodiscard]] base::Result<experiment::PlayedSession>
    played(const experiment::SessionSpec& spec, const experiment::PlaySession& play);

    struct Counts {
        std::size_t played = 0;
        std::size_t reused = 0; // sessions that an earlier run had played
    };
    [[nodiscard]] Counts counts() const;

    /// Describes the damaged lines of the files: the number of lines that are not a session with
    /// the right checksum, and the place of the first; nullopt: there are none. A line is cut off
    /// when its writer was killed.
    [[nodiscard]] std::optional<std::string> damage() const;
    [[nodiscard]] std::size_t damaged_lines() const { return damaged_; }

private:
    /// The place where a session is stored.
    struct Place {
        std::size_t file = 0;
        std::uint64_t offset = 0;
        std::uint32_t length = 0;
        bool is_from_before = false; // from an earlier run, and not yet requested in this one
    };
    struct File {
        disk::Descriptor descriptor;
        std::string path;
        std::uint64_t length = 0;
    };

    explicit SessionStore(std::string program);
    /// Reads the last of the files.
    [[nodiscard]] base::Result<void> read_last(const FolderIdentity& identity);
    /// Adds a line to the index. Returns false when the line is damaged.
    [[nodiscard]] bool take_line(std::string_view text, const Place& place);
    void append(const std::string& line);
    /// Returns the place where the session of a key is stored; nullopt: it is not stored.
    [[nodiscard]] std::optional<Place> place_of(const std::string& key);
    [[nodiscard]] experiment::PlayedSession read_at(const Place& place,
                                                    const std::string& key) const;

    std::string program_;
    std::vector<File> files_;
    bool is_writable_ = false; // true: there is one file, and sessions are appended to it
    std::size_t damaged_ = 0;
    std::string first_damaged_; // place of the first damaged line, as "FILE:LINE"

    mutable std::mutex mutex_; // guards all members below and the length of the written file
    std::condition_variable changed_;
    std::unordered_map<std::size_t, Place> places_; // by the hash of a session's key
    std::set<std::string> being_played_;
    Counts counts_;
};

} // namespace hapnet::lab::runner

// SPDX-License-Identifier: BSD-3-Clause
// http://wiki.ros.org/Bags/Format/2.0: records of a head (fields NAME=VALUE) and data, each with its
// length before it. After a chunk of messages stand its index records, one for each connection; a
// connection says topic and type.
#include "nodes/formats/bag.hpp"

#include <algorithm>
#include <fstream>
#include <mutex>
#include <optional>
#include <sstream>
#include <stdexcept>
#include <tuple>

#include "nodes/formats/file_bytes.hpp"
#include "nodes/formats/inflate.hpp"

namespace posevote::formats {
namespace {

namespace fs = std::filesystem;
using Fields = std::map<std::string, std::string, std::less<>>;

constexpr std::string_view kMagic = "#ROSBAG V2.0\n";
/// Names of topics become paths.
constexpr std::string_view kInTopics =
    "/ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789_-.~";
constexpr std::uint32_t kMostHead = 1 << 20;  // a definition of a message stands in data
enum Kind { kMessage = 2, kBagHead = 3, kIndex = 4, kChunk = 5, kChunkInfo = 6, kConnection = 7 };

struct Record {
  std::uint64_t at = 0, data_at = 0;
  std::uint32_t data_size = 0;
  Fields fields{};

  std::uint64_t end() const { return data_at + data_size; }
};

[[noreturn]] void fail_at(std::uint64_t at, const std::string& what) {
  throw std::runtime_error("damaged bag: at byte " + std::to_string(at) + ": " + what);
}

template <class T>
T number(const Record& record, std::string_view name) {
  const auto field = record.fields.find(name);
  if (field == record.fields.end() || field->second.size() != sizeof(T))
    fail_at(record.at, "a record without its '" + std::string(name) + "'");
  return load_bytes<T>(field->second.data());
}

const std::string& text(const Record& record, std::string_view name) {
  const auto field = record.fields.find(name);
  if (field == record.fields.end())
    fail_at(record.at, "a record without its '" + std::string(name) + "'");
  return field->second;
}

/// Seconds, then nanoseconds.
std::uint64_t time_of(const char* bytes) {
  return load_bytes<std::uint32_t>(bytes) * std::uint64_t{1'000'000'000} +
         load_bytes<std::uint32_t>(bytes + 4);
}

Fields fields_of(std::string_view bytes, std::uint64_t at) {
  Fields fields;
  while (!bytes.empty()) {
    const std::uint64_t size =
        bytes.size() < 4 ? bytes.size() : load_bytes<std::uint32_t>(bytes.data());
    const std::string_view field = bytes.substr(std::min<std::size_t>(4, bytes.size()), size);
    const std::size_t equals = field.find('=');
    if (field.size() != size || equals == std::string_view::npos)
      fail_at(at, "a field that is none");
    fields.emplace(field.substr(0, equals), field.substr(equals + 1));
    bytes.remove_prefix(4 + size);
  }
  return fields;
}

/// What lies between two places of a file, or of a chunk.
class Records {
 public:
  Records(std::istream& stream, std::uint64_t size) : stream_(stream), size_(size) {}

  std::string bytes(std::uint64_t at, std::uint64_t count) {
    if (at > size_ || count > size_ - at)
      throw std::runtime_error("is cut off: " + std::to_string(count) + " bytes at byte " +
                               std::to_string(at) + " of " + std::to_string(size_));
    std::string bytes(count, '\0');
    stream_.clear();
    stream_.seekg(static_cast<std::streamoff>(at));
    if (!stream_.read(bytes.data(), static_cast<std::streamsize>(count)))
      fail_at(at, "cannot be read");
    return bytes;
  }
  std::uint32_t length(std::uint64_t at) { return load_bytes<std::uint32_t>(bytes(at, 4).data()); }
  Record record(std::uint64_t at) {
    const std::uint32_t head = length(at);
    if (head > kMostHead) fail_at(at, "a record's head of " + std::to_string(head) + " bytes");
    Record record{at, at + 8 + head, length(at + 4 + head), fields_of(bytes(at + 4, head), at)};
    if (record.end() > size_)
      throw std::runtime_error("is cut off: a record at byte " + std::to_string(at) + " ends at " +
                               std::to_string(record.end()) + " of " + std::to_string(size_));
    return record;
  }
  std::string data(const Record& record) { return bytes(record.data_at, record.data_size); }
  std::uint64_t size() const { return size_; }

 private:
  std::istream& stream_;
  std::uint64_t size_;
};

std::uint64_t size_of(const fs::path& file) {
  std::error_code problem;
  const std::uintmax_t size = fs::file_size(file, problem);
  if (problem) throw std::runtime_error("cannot be read: " + problem.message());
  return size;
}

/// The records of a whole bag, one after the other.
class Index {
 public:
  Index(std::istream& stream, std::uint64_t size) : records_(stream, size) {
    if (size < kMagic.size() || records_.bytes(0, kMagic.size()) != kMagic)
      throw std::runtime_error("not a ROS bag of format 2.0");
    for (std::uint64_t at = kMagic.size(); at < size;) {
      const Record record = records_.record(at);
      add(record);
      at = record.end();
    }
    check_complete();
  }

  std::map<std::string, BagTopic> topics() const {
    std::map<std::string, BagTopic> topics;
    for (const auto& [id, connection] : connections_) {
      BagTopic& topic = topics[connection.topic];
      if (!topic.type.empty() && topic.type != connection.type)
        throw std::runtime_error("its topic " + in_quotes(connection.topic) + " is of the types " +
                                 in_quotes(topic.type) + " and " + in_quotes(connection.type));
      topic.type = connection.type;
    }
    for (const auto& [id, messages] : messages_) {
      if (!connections_.contains(id))
        throw std::runtime_error("damaged bag: messages of an unknown connection");
      auto& all = topics[connections_.at(id).topic].messages;
      all.insert(all.end(), messages.begin(), messages.end());
    }
    for (auto& [name, topic] : topics)
      std::stable_sort(
          topic.messages.begin(), topic.messages.end(), [](const auto& a, const auto& b) {
            return std::tie(a.time, a.chunk, a.offset) < std::tie(b.time, b.chunk, b.offset);
          });
    return topics;
  }

 private:
  struct Connection {
    std::string topic, type;
  };

  void add(const Record& record) {
    switch (number<std::uint8_t>(record, "op")) {
      case kBagHead:
        head_ = record;
        return check_head();
      case kChunk:
        chunk_ = record;
        return void(++chunks_);
      case kChunkInfo:
        return void(++infos_);
      case kConnection:
        return add_connection(record);
      case kIndex:
        return add_index(record);
      default:
        fail_at(record.at, "a record of an unknown kind");
    }
  }

  void check_head() const {
    if (head_->fields.contains("encryptor") && !text(*head_, "encryptor").empty())
      throw std::runtime_error("is encrypted");
    const auto index = number<std::uint64_t>(*head_, "index_pos");
    if (index == 0)
      throw std::runtime_error("was not closed by its recorder; `rosbag reindex` mends that");
    if (index > records_.size())
      throw std::runtime_error("is cut off: its index is said to be at byte " +
                               std::to_string(index) + " of " + std::to_string(records_.size()));
  }

  void add_connection(const Record& record) {
    const Fields said = fields_of(records_.data(record), record.at);
    const auto type = said.find("type");
    if (type == said.end()) fail_at(record.at, "a connection without a type");
    std::string topic = text(record, "topic");
    if (!topic.starts_with('/')) topic = '/' + topic;
    if (fs::path(topic).lexically_normal().string() != topic || topic.back() == '/' ||
        topic.find_first_not_of(kInTopics) != std::string::npos)
      fail_at(record.at, "a topic of the name " + in_quotes(topic));
    connections_[number<std::uint32_t>(record, "conn")] = {topic, type->second};
  }

  void add_index(const Record& record) {
    constexpr std::size_t kEntry = 12;
    const auto count = number<std::uint32_t>(record, "count");
    if (!chunk_) fail_at(record.at, "an index before any chunk");
    if (number<std::uint32_t>(record, "ver") != 1 || record.data_size != count * kEntry)
      fail_at(record.at, "an index that is none");
    const auto size = number<std::uint32_t>(*chunk_, "size");
    const std::string data = records_.data(record);
    auto& messages = messages_[number<std::uint32_t>(record, "conn")];
    for (std::size_t i = 0; i < data.size(); i += kEntry) {
      messages.push_back({time_of(&data[i]), chunk_->at, load_bytes<std::uint32_t>(&data[i + 8])});
      if (messages.back().offset >= size)
        fail_at(record.at, "an index of messages that lie beyond their chunk");
    }
  }

  void check_complete() const {
    if (!head_) throw std::runtime_error("damaged bag: has no head");
    if (number<std::uint32_t>(*head_, "chunk_count") != chunks_ || chunks_ != infos_ ||
        number<std::uint32_t>(*head_, "conn_count") != connections_.size())
      throw std::runtime_error(
          "is cut off or damaged: has not the chunks and connections that its "
          "head tells of");
  }

  Records records_;
  std::optional<Record> head_, chunk_;
  std::uint32_t chunks_ = 0, infos_ = 0;
  std::map<std::uint32_t, Connection> connections_;
  std::map<std::uint32_t, std::vector<BagMessage>> messages_;
};

/// The data of a message's record, if it is the one that the index means.
std::string message_in(Records& records, std::uint64_t at, const BagMessage& message) {
  const Record record = records.record(at);
  if (number<std::uint8_t>(record, "op") != kMessage ||
      time_of(text(record, "time").substr(0, 8).append(8, '\0').data()) != message.time)
    throw std::runtime_error("damaged bag: its index points to no such message");
  return records.data(record);
}

std::ifstream open_file(const fs::path& file) {
  std::ifstream stream(file, std::ios::binary);
  if (!stream) throw std::runtime_error("cannot be opened");
  return stream;
}

}  // namespace

Bag::Bag(fs::path file) : file_(std::move(file)) {
  std::ifstream stream = open_file(file_);
  topics_ = Index(stream, size_of(file_)).topics();
}

std::string Bag::read(const BagMessage& message) const {
  std::ifstream stream = open_file(file_);
  Records records(stream, size_of(file_));
  const Record chunk = records.record(message.chunk);
  const std::string& compression = text(chunk, "compression");
  if (compression == "none") {
    Records inside(stream, chunk.end());
    return message_in(inside, chunk.data_at + message.offset, message);
  }
  std::string bytes =
      inflate(records.data(chunk), compression, number<std::uint32_t>(chunk, "size"));
  const std::uint64_t size = bytes.size();
  std::istringstream inflated(std::move(bytes));
  Records inside(inflated, size);
  return message_in(inside, message.offset, message);
}

std::shared_ptr<const Bag> open_bag(const fs::path& file) {
  struct Opened {
    fs::path file;
    fs::file_time_type written;
    std::uint64_t size = 0;
    std::shared_ptr<const Bag> bag;
  };
  static std::mutex mutex;
  static Opened last;
  const std::lock_guard lock(mutex);
  const std::uint64_t size = size_of(file);
  const fs::file_time_type written = fs::last_write_time(file);
  if (!last.bag || last.file != file || last.written != written || last.size != size)
    last = {file, written, size, std::make_shared<const Bag>(file)};
  return last.bag;
}

}  // namespace posevote::formats

#include "io/json_record.hpp"

#include "io/atomic_file.hpp"

#include <nlohmann/json.hpp>

namespace scarp::io {

void write_json(const std::filesystem::path& path, const nlohmann::ordered_json& record) {
  write_atomically(path, record.dump(2) + "\n");
}

} // namespace scarp::io

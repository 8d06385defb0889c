#include "chainmail/moves.h"

#include <utility>

#include "api/access.h"
#include "api/recorded_moves.h"
#include "chainmail/text.h"
#include "report/run/runner.h"
#include "simulate/move_history.h"
#ifdef CHAINMAIL_HAS_JSON
#include "files/session/moves.h"
#endif

namespace chainmail::api {

std::size_t RecordedMoves::pass_count() const { return std::size_t(report::count_moves(impl_->moves)); }
const Mesh& RecordedMoves::last_mesh() const { return impl_->last_mesh; }

#ifdef CHAINMAIL_HAS_JSON

RecordedMoves read_moves(const std::filesystem::path& path, const Mesh& mesh, const Job& job) {
  return guarded([&] {
    const MeshPointer& first = Access::pointer(mesh);
    report::RecordedMoves moves{"recorded", "recorded in " + printable(path.filename().string()),
                                inner::read_moves(path, first, Access::progress(job))};
    const MeshPointer last = inner::last_mesh(first, moves.commands);
    return Access::make<RecordedMoves>(std::move(moves), last == first ? mesh : Access::mesh(last));
  });
}

#else

RecordedMoves read_moves(const std::filesystem::path& path, const Mesh& /*mesh*/, const Job& /*job*/) {
  refuse_without("nlohmann/json", path.string());
}

#endif

}  // namespace chainmail::api

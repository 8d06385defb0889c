#include "chainmail/session.h"

#include "api/access.h"
#ifdef CHAINMAIL_HAS_JSON
#include "files/session/session.h"
#endif

namespace chainmail::api {

#ifdef CHAINMAIL_HAS_JSON

bool is_session(const std::filesystem::path& path) { return inner::is_session(path); }

Body read_session(const std::filesystem::path& path, const SessionMeshOpener& open, const Job& job) {
  return guarded([&] {
    MeshOpener opener;
    if (open) {
      opener = [&](const std::string& name, std::uint32_t /*across*/, const Progress& /*progress*/) {
        return Access::pointer(open(name));
      };
    }
    const Session session = inner::read_session(path, Access::progress(job), opener);
    Body body(Access::mesh(session.mesh));
    auto& impl = Access::impl(body);
    impl.body().restore(session.panels.front().positions, every_block(*session.mesh));
    impl.body().cut(session.cuts);
    impl.body().pin(session.pins);
    impl.set_softness(*session.softness);
    impl.body().set_elastic(session.elastic);
    return body;
  });
}

#else

bool is_session(const std::filesystem::path& /*path*/) { return false; }
Body read_session(const std::filesystem::path& path, const SessionMeshOpener& /*open*/, const Job& /*job*/) {
  refuse_without("nlohmann/json", path.string());
}

#endif

}  // namespace chainmail::api

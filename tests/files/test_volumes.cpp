#include <QtTest>
#include <random>

#include "files/formats/metaimage.h"
#include "files/formats/nrrd_head.h"
#include "files/mesh/open_mesh.h"
#include "files/support.h"
#include "program.h"

namespace chainmail::test_volumes {

using namespace chainmail::test;

namespace {

Volume volume_of(const std::array<std::uint32_t, 3>& size, const std::vector<double>& densities) {
  Volume volume;
  volume.size = size;
  take_densities(volume, "volume", [&](std::size_t i) { return densities[i]; });
  return volume;
}

const std::string head =
    "ObjectType = Image\nNDims = 3\nDimSize = 2 2 1\nElementSpacing = 0.5 1 2\nOffset = 1 2 3\n"
    "ElementType = MET_USHORT\nBinaryDataByteOrderMSB = True\n";

/// Returns the memory of this process (bytes): the current one for VmRSS, the largest one so far for VmHWM.
std::size_t resident(const std::string& name) {
  std::ifstream lines("/proc/self/status");
  for (std::string word; lines >> word;) {
    std::size_t kilobytes = 0;
    if (word == name + ":" && lines >> kilobytes) {
      return kilobytes << 10;
    }
  }
  return 0;
}
void forget_the_most_resident() { std::ofstream("/proc/self/clear_refs") << "5"; }
/// Returns the variance between the two classes that a threshold separates, by its definition (Otsu 1979, equation 14).
double variance_between(const Volume& volume, double threshold) {
  std::array<double, 2> count{}, sum{};
  for (std::size_t i = 0; i < volume.voxel_count(); ++i) {
    const std::size_t of = volume.density(i) >= threshold ? 1 : 0;
    count[of] += 1;
    sum[of] += volume.density(i);
  }
  if (count[0] == 0 || count[1] == 0) {
    return 0;
  }
  const double all = count[0] + count[1], apart = sum[1] / count[1] - sum[0] / count[0];
  return count[0] / all * (count[1] / all) * apart * apart;
}

}  // namespace

/// Volumes of voxels are read with their positions and densities, and converted to objects.
class VolumesTest : public QObject {
  Q_OBJECT

 private slots:
  void densities_of_16_bits_are_exact();
  void others_are_near_to_a_65535th();
  void a_head_says_what_the_data_are();
  void heads_of_other_programs_use_other_keys();
  void heads_that_do_not_are_refused_data();
  void heads_that_do_not_are_refused();
  void data_that_end_too_soon_are_refused();
  void packed_data_are_unpacked_in_pieces();
  void an_nrrd_header_names_data_data();
  void an_nrrd_header_names_data();
  void voxels_above_a_threshold_are_elements();
  void several_voxels_make_one_element();
  void what_is_left_at_the_border_makes_an_element_too();
  void a_brick_is_not_larger_than_the_volume();
  void bricks_depend_on_the_size_only_where_it_is_long();
  void a_volume_beyond_memory_is_averaged();
  void data_too_short_for_their_voxels_are_refused_at_once();
  void what_is_dense_is_stiff();
  void otsu_parts_two_heaps();
  void otsu_finds_the_largest_variance_between_classes();
  void each_voxel_shows_its_density_at_its_centre();
  void nothing_above_the_threshold_is_said();
};

void VolumesTest::densities_of_16_bits_are_exact() {
  const auto volume = volume_of({3, 1, 1}, {-1000, 64535, 12});
  QCOMPARE(volume.density(0), -1000.0);
  QCOMPARE(volume.density(1), 64535.0);
  QCOMPARE(volume.density(2), 12.0);
}

void VolumesTest::others_are_near_to_a_65535th() {
  const auto volume = volume_of({3, 1, 1}, {0.25, 1e-3, 7});
  for (const auto& [voxel, density] : {std::pair(0, 0.25), {1, 1e-3}, {2, 7.0}}) {
    QVERIFY(std::abs(volume.density(std::size_t(voxel)) - density) <=
            7.0 / 65535 / 2 * 1.01);  // half a step of density
  }
  QVERIFY(error_of([] { volume_of({2, 1, 1}, {1, std::nan("")}); }).startsWith("volume: the density of voxel 1 is no"));
}

void VolumesTest::a_head_says_what_the_data_are() {
  const std::string text = head + "ElementDataFile = LOCAL\n";
  const std::string data{"\x01\x00\x00\x02\x00\x03\x10\x00", 8};
  const auto read = read_metaimage_head(text + data, "a.mha");
  QCOMPARE(read.length, text.size());
  const auto volume = metaimage_volume(read, data, "a.mha");
  QCOMPARE(volume.size, (std::array<std::uint32_t, 3>{2, 2, 1}));
  QCOMPARE(volume.spacing, Point(0.5, 1, 2));
  QCOMPARE(volume.origin, Point(1, 2, 3));
  QCOMPARE(volume.density(0), 256.0);  // big-endian: the highest byte comes first
  QCOMPARE(volume.density(1), 2.0);
  QCOMPARE(volume.density(3), 4096.0);
}

/// 'Position' and 'Origin' are other names of 'Offset'. The absolute value of a negative spacing is the distance
/// between voxels.
void VolumesTest::heads_of_other_programs_use_other_keys() {
  const std::string size = "NDims = 3\nDimSize = 1 1 1\nElementType = MET_UCHAR\n", end = "ElementDataFile = LOCAL\n";
  for (const char* key : {"Offset", "Position", "Origin"}) {
    QCOMPARE(read_metaimage_head(size + key + " = 1 -2 3\n" + end, "a.mha").origin, Point(1, -2, 3));
  }
  for (const char* key : {"ElementSpacing", "ElementSize"}) {
    QCOMPARE(read_metaimage_head(size + key + " = 0.5 -1 2\n" + end, "a.mha").spacing, Point(0.5, 1, 2));
  }
  // If the spacing is missing, the size of a voxel replaces it. The order of the lines does not matter.
  for (const char* both :
       {"ElementSpacing = 3 3 3\nElementSize = 1 2 1\n", "ElementSize = 1 2 1\nElementSpacing = 3 3 3\n"}) {
    QCOMPARE(read_metaimage_head(size + both + end, "a.mha").spacing, Point(3, 3, 3));
  }
}

void VolumesTest::heads_that_do_not_are_refused_data() {
  QTest::addColumn<QByteArray>("text");
  QTest::addColumn<QString>("sentence");
  QTest::newRow("no data") << QByteArray::fromStdString(head)
                           << "a.mha:8: the header ends before its line 'ElementDataFile = …'; ";
  QTest::newRow("no line") << QByteArray("NDims = 3\nfoo\n") << "a.mha:2: 'foo' is not a line of a header; ";
  QTest::newRow("plane") << QByteArray("NDims = 2\nElementDataFile = LOCAL\n")
                         << "a.mha:1: it is an image of 2 dimensions; ";
  QTest::newRow("size") << QByteArray("NDims = 3\nDimSize = 2 -1 1\n") << "a.mha:2: a size is not a whole number";
  QTest::newRow("huge") << QByteArray("NDims = 3\nDimSize = 2 1e300 1\n") << "a.mha:2: ";
  QTest::newRow("channels") << QByteArray("NDims = 3\nElementNumberOfChannels = 3\nElementDataFile = LOCAL\n")
                            << "the image has 3 numbers per voxel; ";
  QTest::newRow("list") << QByteArray::fromStdString(head + "ElementDataFile = LIST\n") << "a.mha:8: it names ";
  QTest::newRow("pattern") << QByteArray::fromStdString(head + "ElementDataFile = %s.raw 1 2\n")
                           << "a.mha:8: it names 0 data files";
  QTest::newRow("many files") << QByteArray("NDims = 3\nDimSize = 1 1 100000\nElementDataFile = %d.raw 1 100000 1\n")
                              << "a.mha:3: it names 0 data files for 100000 parts of its volume, of at most 10000; ";
  QTest::newRow("compressed list") << QByteArray(
                                          "NDims = 3\nCompressedData = True\nDimSize = 1 1 2\n"
                                          "ElementDataFile = LIST\na.raw\nb.raw\n")
                                   << "a.mha:4: its data are text, or compressed in several files";
}

void VolumesTest::heads_that_do_not_are_refused() {
  QFETCH(QByteArray, text);
  QFETCH(QString, sentence);
  const QString error = error_of([&] { read_metaimage_head(text.toStdString(), "a.mha"); });
  QVERIFY2(error.contains(sentence), qPrintable(error));
}

void VolumesTest::data_that_end_too_soon_are_refused() {
  auto read = read_metaimage_head(head + "ElementDataFile = LOCAL\n", "a.mha");
  QVERIFY(error_of([&] {
            metaimage_volume(read, std::string(7, 'x'), "a.mha");
          }).startsWith("a.mha: its data end after 7 of 8 bytes; "));
  read.compressed = true;
  QVERIFY(
      error_of([&] { metaimage_volume(read, std::string(7, 'x'), "a.mha"); }).contains("compressed data are damaged"));
  read.size = {1'000'000, 1'000'000, 1'000'000};
  QVERIFY(error_of([&] { metaimage_volume(read, std::string(7, 'x'), "a.mha"); }).contains("there are more than"));
}

/// 100 KB of compressed data are never decompressed as a whole: memory is taken only for the two bytes per voxel.
void VolumesTest::packed_data_are_unpacked_in_pieces() {
#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
  QSKIP("a sanitizer takes memory of its own");
#endif
  constexpr std::size_t edge = 464;  // 100 million voxels of one byte
  auto read = read_metaimage_head(head + "ElementDataFile = LOCAL\n", "a.mha");
  read.size = {edge, edge, edge};
  read.type = "MET_UCHAR";
  read.compressed = true;
  const std::size_t voxels = edge * edge * edge;
  QByteArray plain(qsizetype(voxels), '\0');
  plain[qsizetype(voxels) / 2] = 7;
  plain.back() = 9;
  const QByteArray packed = qCompress(plain).mid(4);  // skips Qt's own header; zlib's format follows
  plain = QByteArray();
  QVERIFY(packed.size() < 200'000);
  const std::size_t before = resident("VmRSS");
  forget_the_most_resident();
  const auto volume = metaimage_volume(read, std::span(packed.data(), std::size_t(packed.size())), "a.mha");
  QCOMPARE(volume.density(voxels / 2), 7.0);
  QCOMPARE(volume.density(voxels - 1), 9.0);
  QCOMPARE(volume.density(voxels / 2 + 1), 0.0);
  const std::size_t more = resident("VmHWM") - before;
  QVERIFY2(more > voxels && more < voxels * 5 / 2, qPrintable(QString::number(more)));
}

void VolumesTest::an_nrrd_header_names_data_data() {
  QTest::addColumn<QByteArray>("field");
  QTest::addColumn<QString>("name");
  QTest::addColumn<QString>("sentence");
  QTest::newRow("none") << QByteArray("encoding: raw") << ""
                        << "";
  QTest::newRow("one") << QByteArray("data file: a b.raw ") << "a b.raw"
                       << "";
  QTest::newRow("in capitals") << QByteArray("DataFile: a.raw\r") << "a.raw"
                               << "";
  QTest::newRow("a user's own") << QByteArray("data file:=a.raw") << ""
                                << "";
  QTest::newRow("comment") << QByteArray("# data file: a.raw") << ""
                           << "";
  QTest::newRow("list") << QByteArray("data file: LIST\na.raw\nb.raw") << "a.raw|b.raw"
                        << "";
  QTest::newRow("list of planes") << QByteArray("data file: LIST 2\na.raw\nb.raw") << "a.raw|b.raw"
                                  << "";
  QTest::newRow("pattern") << QByteArray("data file: a%03d.raw 7 9 2") << "a007.raw|a009.raw"
                           << "";
  QTest::newRow("pattern of planes") << QByteArray("data file: %3d.raw 1 1 1 2") << "  1.raw"
                                     << "";
  QTest::newRow("many files") << QByteArray("data file: %d.raw 1 4000000000 1") << ""
                              << "a.nhdr:2: it does not name 1 to 256 data files; ";
  QTest::newRow("odd pattern") << QByteArray("data file: %s%n.raw 1 9 1") << ""
                               << "a.nhdr:2: it does not name 1 to 256 data files; ";
  QTest::newRow("nothing") << QByteArray("data file: ") << ""
                           << "a.nhdr:2: it does not name 1 to 256 data files; ";
  QTest::newRow("many lines") << QByteArray(20'010, '#').replace("##", "#\n") << ""
                              << "a.nhdr: its header has more than 10000 lines; ";
  QTest::newRow("twice") << QByteArray("data file: a\ndatafile: b") << ""
                         << "a.nhdr:3: its header names its data twice; ";
  QTest::newRow("odd") << QByteArray(" data file: a") << ""
                       << "a.nhdr:2: ' data file: a' is not a field of a header; ";
  QTest::newRow("two lines in one") << QByteArray("type: char\rdata file: a") << ""
                                    << "a.nhdr:2: a line of its header contains a carriage return; ";
}

/// Teem reads the header, but our code decides which files it opens.
void VolumesTest::an_nrrd_header_names_data() {
  QFETCH(QByteArray, field);
  QFETCH(QString, name);
  QFETCH(QString, sentence);
  const std::string text = "NRRD0001\n" + field.toStdString() + "\n\nfile: of the data\n";
  NrrdHead read;
  const QString error = error_of([&] { read = read_nrrd_head(text, "a.nhdr"); });
  QVERIFY2(sentence.isEmpty() ? error.isEmpty() : error.startsWith(sentence), qPrintable(error));
  QStringList names;
  std::string list;
  for (const std::string& one : read.data_files) {
    list += "\n" + nrrd_data_name(names.size());
    names << QString::fromStdString(one);
  }
  QCOMPARE(names.join('|'), name);
  if (const bool is_list = field.contains("LIST") || field.contains('%'); !name.isEmpty()) {
    QCOMPARE(read.text,
             std::string("NRRD0001\ndata file: ") +
                 (is_list ? std::string("LIST") + (field.contains("2\n") || field.endsWith(" 2") ? " 2" : "") : "") +
                 (is_list ? list : list.substr(1)) + "\n");
  }
}

void VolumesTest::voxels_above_a_threshold_are_elements() {
  // A square of four voxels, one next to it, and one separate.
  const auto volume = volume_of({3, 3, 1}, {5, 5, 5, 5, 5, 0, 0, 0, 5});
  const auto block = voxel_block(volume, {4.0, 1, true}, "v");
  QCOMPARE(block.mesh->element_count(), 6U);
  QCOMPARE(block.mesh->links, (std::vector<std::array<ElementId, 2>>{{0, 1}, {0, 3}, {1, 2}, {1, 4}, {3, 4}}));
  QCOMPARE(block.mesh->rest_position(5), Point(2, 2, 0));
  QVERIFY(block.mesh->texture != nullptr && block.mesh->texture->size == volume.size);
  const auto cube = voxel_block(volume_of({2, 2, 2}, std::vector<double>(8, 3.0)), {3.0, 1, true}, "v");
  QCOMPARE(cube.mesh->hexahedra.size(), std::size_t{1});
  QCOMPARE(cube.mesh->object_dimension, 3);
}

void VolumesTest::several_voxels_make_one_element() {
  // 4 x 2 voxels: the means of the two squares are 2.5 and 10. Only the second one is dense enough.
  const auto block = voxel_block(volume_of({4, 2, 1}, {1, 2, 10, 10, 3, 4, 10, 10}), {2.6, 2, true}, "v");
  QCOMPARE(block.mesh->element_count(), 1U);
  QCOMPARE(block.mesh->rest_position(0), Point(2.5, 0.5, 0));  // there is one layer
  std::vector<double> many(std::size_t{60} * 60 * 60, 1.0);
  const auto coarser = voxel_block(volume_of({60, 60, 60}, many), {0.5, {}, true}, "v");
  QCOMPARE(coarser.every, 2U);  // 216,000 voxels are too many for real time
  QCOMPARE(coarser.mesh->element_count(), 27'000U);
}

/// Five voxels with two per element: the fifth one is an element alone, with its own density.
void VolumesTest::what_is_left_at_the_border_makes_an_element_too() {
  const auto block = voxel_block(volume_of({5, 1, 1}, {9, 9, 9, 9, 9}), {8.0, 2, true}, "v");
  QCOMPARE(block.mesh->element_count(), 3U);
  QCOMPARE(block.mesh->link_count(), 2U);
}

/// Elements of a thin volume stay in it, however many voxels they have along its length.
void VolumesTest::a_brick_is_not_larger_than_the_volume() {
  const auto block = voxel_block(volume_of({8, 2, 1}, std::vector<double>(16, 5)), {4.0, 4, true}, "v");
  QCOMPARE(block.mesh->element_count(), 2U);
  QCOMPARE(block.mesh->rest_position(0), Point(1.5, 0.5, 0));
  QCOMPARE(block.mesh->rest_position(1), Point(5.5, 0.5, 0));
  QCOMPARE(block.mesh->texture->box[1], Point(7.5, 1.5, 0.5));
}

/// A long thin volume needs bricks of many voxels along its length only.
void VolumesTest::bricks_depend_on_the_size_only_where_it_is_long() {
  constexpr std::uint32_t length = 1U << 20;
  std::vector<double> densities(std::size_t{2} * length, 1);
  densities.back() = 0;
  const auto block = voxel_block(volume_of({length, 2, 1}, densities), {0.5, {}, true}, "v");
  QCOMPARE(block.every, 11U);  // 1,048,576 / 11 is below 100,000, and both rows are in one brick
  QCOMPARE(block.mesh->element_count(), (length - 1) / 11 + 1);
  QVERIFY(block.mesh->element_count() <= voxel_elements);
}

/// 7 x 4 x 3 voxels in 12: boxes of 2 x 2 x 2 voxels are 4 x 2 x 2, boxes of 3 x 3 x 3 are 3 x 2 x 1.
void VolumesTest::a_volume_beyond_memory_is_averaged() {
  Volume volume;
  volume.size = {7, 4, 3};
  volume.spacing = Point(1, 10, 100);
  volume.origin = Point(5, 6, 7);
  const auto number = [](std::size_t i) {
    return double(i % 7 / 3 * 100 + i / 7 % 4 / 3 * 10 + (i == 0 ? 54 : 0));  // equal in each box but the first
  };
  take_densities(volume, "v", number, 12);
  QCOMPARE(volume.size, (std::array<std::uint32_t, 3>{3, 2, 1}));
  QCOMPARE(volume.merged, 3U);
  QCOMPARE(volume.spacing, Point(3, 30, 300));
  QCOMPARE(volume.origin, Point(6, 16, 107));
  for (const auto& [voxel, density] : {std::pair(0, 2.0), {1, 100.0}, {2, 200.0}, {3, 10.0}, {4, 110.0}, {5, 210.0}}) {
    QCOMPARE(volume.density(std::size_t(voxel)), density);
  }
  // Voxels per element count those of the file.
  const auto block = voxel_block(volume, {0.0, 6, true}, "v");
  QCOMPARE(block.every, 6U);
  QCOMPARE(block.mesh->element_count(), 2U);
  QCOMPARE(voxel_block(volume, {0.0, 5, true}, "v").every, 6U);  // not fewer than asked for
  QCOMPARE(voxel_block(volume, {0.0, 2, true}, "v").every, 3U);
}

void VolumesTest::data_too_short_for_their_voxels_are_refused_at_once() {
  auto read = read_metaimage_head(head + "ElementDataFile = LOCAL\n", "a.mha");
  read.size = {1024, 1024, 1024};
  read.compressed = true;
  QCOMPARE(error_of([&] { metaimage_volume(read, std::string(100'000, 'x'), "a.mha"); }),
           QString("a.mha: its 100000 bytes of compressed data are too few for its voxels; export it again"));
}

void VolumesTest::what_is_dense_is_stiff() {
  const auto volume = volume_of({4, 1, 1}, {10, 10, 20, 20});
  const auto block = voxel_block(volume, {10.0, 1, true}, "v");
  QVERIFY(!block.softness.contains(0));                               // at the threshold: the default
  QCOMPARE(*block.softness.find(1), (LinkSoftness{0.9, 1.1, 0.05}));  // halfway, exact in binary steps of 1/32
  QCOMPARE(*block.softness.find(2), (LinkSoftness{1, 1, 0}));
  QVERIFY(voxel_block(volume, {10.0, 1, false}, "v").softness.empty());
}

void VolumesTest::otsu_parts_two_heaps() {
  const double threshold = otsu_threshold(volume_of({6, 1, 1}, {0, 1, 2, 100, 101, 102}));
  QVERIFY(threshold > 2 && threshold <= 100);
}

/// The threshold is as good as the best of all thresholds. Some volumes have few different densities, so that several
/// thresholds are equally good.
void VolumesTest::otsu_finds_the_largest_variance_between_classes() {
  std::mt19937_64 random(5);
  for (int trial = 0; trial < 500; ++trial) {
    const std::size_t count = 2 + random() % 30;
    const std::uint64_t different = 2 + random() % (trial % 2 == 0 ? 6 : 3000);
    const double unit = trial % 3 == 0 ? 0.37 : 1;
    std::vector<double> densities{-7 * unit, -6 * unit};
    while (densities.size() < count) {
      densities.push_back(unit * double(random() % different));
    }
    const auto volume = volume_of({std::uint32_t(densities.size()), 1, 1}, densities);
    double best = 0;
    for (std::size_t i = 0; i < volume.voxel_count(); ++i) {
      best = std::max(best, variance_between(volume, volume.density(i)));
    }
    const double threshold = otsu_threshold(volume);
    QVERIFY2(variance_between(volume, threshold) >= best * (1 - 1e-12), qPrintable(QString::number(threshold)));
  }
  QCOMPARE(otsu_threshold(volume_of({4, 1, 1}, {0, 10, 90, 100})), 50.0);  // midway between the classes
  // Two thresholds are equally good: one separates the lowest density, one the highest. Those between them are worse.
  const auto tied = volume_of({4, 1, 1}, {0, 13, 17, 30});
  QCOMPARE(variance_between(tied, 13), variance_between(tied, 30));
  QVERIFY(variance_between(tied, otsu_threshold(tied)) > variance_between(tied, 17));
}

/// A section through the object shows at each element the density of its voxel.
void VolumesTest::each_voxel_shows_its_density_at_its_centre() {
  std::vector<double> densities;
  for (int i = 0; i < 3 * 2 * 4; ++i) {
    densities.push_back(100 + 7 * ((5 * i) % 24));
  }
  auto volume = volume_of({3, 2, 4}, densities);
  volume.spacing = Point(0.5, 1, 2);
  volume.origin = Point(1, -2, 30);
  const auto mesh = voxel_block(volume, {100.0, 1, true}, "v").mesh;
  QCOMPARE(std::size_t(mesh->element_count()), densities.size());
  const Texture& texture = *mesh->texture;
  const auto& [low, high] = texture.box;
  for (ElementId e = 0; e < mesh->element_count(); ++e) {
    const Eigen::Vector3d voxel(e % 3, e / 3 % 2, e / 6);
    const Point centre = volume.origin + volume.spacing.cwiseProduct(voxel);
    QCOMPARE(mesh->rest_position(e), centre);
    std::size_t texel = 0;
    for (int k = 2; k >= 0; --k) {
      const double at = (centre[k] - low[k]) / (high[k] - low[k]) * texture.size[k];  // in texels
      QVERIFY(std::abs(at - (voxel[k] + 0.5)) < 1e-12);
      texel = texel * texture.size[k] + std::size_t(at);
    }
    QCOMPARE(int(texture.texels[texel]), int(std::lround(255 * (densities[e] - 100) / (7 * 23))));
  }
}

void VolumesTest::nothing_above_the_threshold_is_said() {
  QCOMPARE(error_of([] {
             voxel_block(volume_of({2, 1, 1}, {1, 2}), {3.5, 1, true}, "a.nrrd");
           }),
           QString("a.nrrd: no voxel has a density of 3.5 or more; choose a lower density"));
}

CHAINMAIL_TEST(VolumesTest)

}  // namespace chainmail::test_volumes

#include "test_volumes.moc"

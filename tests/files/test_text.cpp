#include <QtTest>
#include <cmath>
#include <limits>
#include <sstream>

#include "files/text/text.h"
#include "program.h"

namespace chainmail::test_text {

/// Tests words and numbers as they occur in files and command lines.
class TextTest : public QObject {
  Q_OBJECT

 private slots:
  void numbers_data();
  void numbers();
  void numbers_are_the_nearest_double();
  void written_numbers_read_back_the_same();
  void counts();
  void lines_end_in_any_way();
  void words_are_parted_by_blanks();
  void long_texts_are_written_whole();
  void messages_stay_one_line_of_text();
  void long_texts_are_shortened_between_characters();
  void statements_are_told_from_prose();
};

void TextTest::numbers_data() {
  QTest::addColumn<QByteArray>("word");
  QTest::addColumn<bool>("is_number");
  QTest::addColumn<double>("number");
  for (const auto& [word, number] : {std::pair{"0", 0.0},
                                     {"-1.5", -1.5},
                                     {"+2", 2.0},
                                     {".5", 0.5},
                                     {"5.", 5.0},
                                     {"1e3", 1000.0},
                                     {"-2E-2", -0.02}}) {
    QTest::newRow(word) << QByteArray(word) << true << number;
  }
  for (const char* word :
       {"", "-", "+", "+-1", "--1", "nan", "inf", "-inf", "1e999", "0.001e+999", "1x", "x", "1,5", "0x10", "1 "}) {
    QTest::newRow(word) << QByteArray(word) << false << 0.0;
  }
}

void TextTest::numbers() {
  QFETCH(QByteArray, word);
  QFETCH(bool, is_number);
  QFETCH(double, number);
  const auto read = parse_number(word.toStdString());
  QCOMPARE(read.has_value(), is_number);
  if (is_number) {
    QCOMPARE(*read, number);
  }
}

void TextTest::numbers_are_the_nearest_double() {
  QVERIFY(parse_number("0.1") == 0.1);
  QVERIFY(parse_number("123456789.123456789") == 123456789.123456789);
  QVERIFY(parse_number("1.7976931348623157e308") == std::numeric_limits<double>::max());
  QVERIFY(parse_number("5e-324") == std::numeric_limits<double>::denorm_min());
}

void TextTest::written_numbers_read_back_the_same() {
  for (const double number : {0.1, 1.0 / 3, -0.0, 1e-300, 123456789.0, std::nextafter(1.0, 2.0), double(0.1F)}) {
    std::string text;
    append_number(text, number);
    const auto read = parse_number(text);
    QVERIFY(read && *read == number && std::signbit(*read) == std::signbit(number));
  }
  std::string short_text;
  append_number(short_text, 0.1);
  QCOMPARE(short_text, std::string("0.1"));
}

void TextTest::counts() {
  QVERIFY(parse_count("0") == 0U);
  QVERIFY(parse_count("4294967295") == 4294967295U);
  for (const char* word : {"", "-1", "+1", "4294967296", "1.0", "1e2", " 1", "x"}) {
    QVERIFY2(!parse_count(word), word);
  }
}

void TextTest::lines_end_in_any_way() {
  Lines lines(
      "\xef\xbb\xbf"
      "a\nb\r\nc\rd\n\ne");
  std::vector<std::string> read;
  while (lines.next()) {
    read.emplace_back(lines.line());
  }
  QCOMPARE(read, (std::vector<std::string>{"a", "b", "c", "d", "", "e"}));
  QCOMPARE(lines.number(), std::size_t{6});
}

void TextTest::words_are_parted_by_blanks() {
  std::string_view line = "  one\ttwo \t three ";
  QCOMPARE(take_word(line), std::string_view("one"));
  QCOMPARE(take_word(line), std::string_view("two"));
  QCOMPARE(take_word(line), std::string_view("three"));
  QVERIFY(take_word(line).empty());
  std::string_view part = std::string_view("one  two").substr(0, 3);  // a blank follows, but not in this text
  QCOMPARE(take_word(part), std::string_view("one"));
  QVERIFY(take_word(part).empty() && part.empty());
}

void TextTest::long_texts_are_written_whole() {
  std::ostringstream out;
  TextBlocks blocks(out);
  std::string expected;
  char letter = 'a';
  for (const std::size_t size : {1, 65'450, 70, 0, 31, 65'536, 500'000, 3}) {  // a block has 65,536 characters
    const std::string text(size, letter++);
    blocks << text << '\n';
    expected += text + '\n';
  }
  blocks.flush();
  QVERIFY(out.str() == expected);
}

void TextTest::messages_stay_one_line_of_text() {
  QCOMPARE(printable("a\nb\x1b[1m\x7f"), std::string("a\\x0ab\\x1b[1m\\x7f"));
  QCOMPARE(printable("é…𝄞"), std::string("é…𝄞"));
  QCOMPARE(printable("\xff\xc3"), std::string("\\xff\\xc3"));
  QCOMPARE(printable("\xc0\xaf\xed\xa0\x80"),
           std::string("\\xc0\\xaf\\xed\\xa0\\x80"));  // an overlong form and a surrogate
  QCOMPARE(in_quotes(std::string(100, 'a')), "'" + std::string(40, 'a') + "…'");
  QCOMPARE(shown(std::filesystem::path("a\nb.dat"), 7), std::string("a\\x0ab.dat:7"));
}

void TextTest::long_texts_are_shortened_between_characters() {
  QCOMPARE(shortened("abcdef", 6), std::string("abcdef"));
  QCOMPARE(shortened("abcdefg", 6), std::string("abc…"));
  QCOMPARE(shortened("abßdefg", 6), std::string("ab…"));  // the character of two bytes does not fit
  QCOMPARE(shortened("aßdefgh", 6), std::string("aß…"));
}

void TextTest::statements_are_told_from_prose() {
  QCOMPARE(stated("# size 3 4", "size").value_or(""), std::string_view(" 3 4"));
  QCOMPARE(stated("  #size 3", "size").value_or(""), std::string_view(" 3"));
  for (const char* line : {"# size", "# size of the mesh", "size 3", "# sizes 3", "# the size 3", ""}) {
    QVERIFY2(!stated(line, "size"), line);
  }
}

CHAINMAIL_TEST(TextTest)

}  // namespace chainmail::test_text

#include "test_text.moc"

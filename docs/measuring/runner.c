/* Draws the probes of a folder on this machine's card and writes the codes that it stored, as a table that
 * `crossbar measure` reads. docs/measuring.md says how to build and run it. C99 and the system's own libraries:
 * Direct3D 9 on Windows (direct3d9.h), OpenGL through GLX elsewhere (opengl.h). Programs and probes are read here, the
 * interface draws them, and the table is written at the end. */
#include <ctype.h>
#include <dirent.h>
#include <errno.h>
#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#define LINES 64
enum { POSITION, COLOR0, COLOR1, COORDINATE0, COORDINATE1, ATTRIBUTES };
typedef float Vector[4];
typedef struct {
    char kind;
    int number, swizzle[4], negated;
} Operand; /* kind: r, c, v, t or s; C for oC, P for oPos, D for oD */
typedef struct {
    char name[16];
    Operand to, from[3];
    int sources, mask, shift, saturated, together; /* shift: power of two of the result; together: written with `+` */
} Step;
typedef struct {
    int major, minor, vertex, count;
    Step step[LINES];
    Vector constant[8];
    int set[8];
} Program;
typedef struct {
    char device[16], format[16], address[16], mip[16];
    Program pixel, vertex;
    int size[2], corners, strips; /* strips: vertices of one primitive, a triangle or the quad of the screen */
    Vector corner[12][ATTRIBUTES];
    int textured, texels[2], linear, automatic, depth;
    double texel[64][4], border[4], bias;
} Probe;
enum { TARGET = 16 };
typedef struct {
    unsigned char color[TARGET][TARGET][4];
    int depth[TARGET][TARGET];
} Image;

static char reason[256]; /* why the last probe cannot be drawn here */

/* Ends the program; nothing has been written by then. */
static void die(const char *format, ...) {
    va_list list;
    va_start(list, format);
    fputs("runner: ", stderr);
    vfprintf(stderr, format, list);
    fputc('\n', stderr);
    va_end(list);
    exit(2);
}

static int refuse(const char *format, ...) {
    va_list list;
    va_start(list, format);
    vsnprintf(reason, sizeof reason, format, list);
    va_end(list);
    return 0;
}

/* The table as text; it is written to disk when it is complete. */
static char *table;
static size_t written, room;

static void put(const char *format, ...) {
    va_list list;
    if (room < written + 4096 && !(table = realloc(table, room += 1 << 20))) die("no memory");
    va_start(list, format);
    int length = vsnprintf(table + written, 4096, format, list);
    va_end(list);
    if (length < 0 || length >= 4096) die("a line of the table is too long");
    written += (size_t)length;
}

/* ---- Programs: Direct3D's assembler, as far as the probes use it ---- */

/* Reads `rN`, `oC0` and so on; returns what follows, or NULL. */
static const char *read_register(const char *text, Operand *operand) {
    static const char *const outputs[] = {"oPos", "oC", "oD"};
    static const char kinds[] = "PCD";
    memset(operand, 0, sizeof *operand);
    for (int i = 0; i < 4; i++) operand->swizzle[i] = i;
    for (int i = 0; i < 3; i++)
        if (!strncmp(text, outputs[i], strlen(outputs[i]))) {
            operand->kind = kinds[i];
            text += strlen(outputs[i]);
            break;
        }
    if (!operand->kind) {
        if (!*text || !strchr("rcvts", *text) || !isdigit((unsigned char)text[1])) return NULL;
        operand->kind = *text++;
    }
    while (isdigit((unsigned char)*text)) operand->number = operand->number * 10 + *text++ - '0';
    return operand->number < 8 ? text : NULL;
}

/* Reads the letters after a dot, both as a swizzle (whose last letter is repeated) and as a mask. */
static const char *read_components(const char *text, int swizzle[4], int *mask) {
    int count = 0;
    *mask = 15;
    if (*text != '.') return text;
    for (*mask = 0, text++; *text && !strchr(", ", *text); text++, count++) {
        const char *names = "xyzwrgba", *found = strchr(names, *text);
        if (!found || count == 4) return NULL;
        *mask |= 1 << (found - names) % 4;
        for (int i = count; i < 4; i++) swizzle[i] = (int)(found - names) % 4;
    }
    return text;
}

/* Splits `name_x2 dst, src, ...`; returns 0 if it does not know the line. */
static int read_step(Program *program, char *line) {
    static const char *const names[] = {"mov",   "add", "sub",    "mul",          "mad",       "lrp",      "rcp",
                                        "dp3",   "dp4", "tex",    "texld",        "texcrd",    "texdepth", "texkill",
                                        "phase", "dcl", "dcl_2d", "dcl_position", "dcl_color0"};
    Step step = {.mask = 15};
    int known = 0, ignored, unused[4];
    if (*line == '+') step.together = 1, line++;
    char *text = line + strcspn(line, " ");
    if (*text) *text++ = 0;
    for (char *mark; (mark = strrchr(line, '_')) && strncmp(line, "dcl", 3); *mark = 0) {
        if (!strcmp(mark, "_sat")) step.saturated = 1;
        else if (mark[1] == 'x' && strchr("248", mark[2])) step.shift = mark[2] == '2' ? 1 : mark[2] == '4' ? 2 : 3;
        else if (mark[1] == 'd' && strchr("248", mark[2])) step.shift = mark[2] == '2' ? -1 : mark[2] == '4' ? -2 : -3;
        else return 0;
    }
    if (!strcmp(line, "def")) {
        Operand constant;
        const char *rest = read_register(text, &constant);
        if (!rest || constant.kind != 'c') return 0;
        for (int i = 0; i < 4; i++) {
            char *end;
            if (*rest != ',') return 0;
            program->constant[constant.number][i] = strtof(rest + 1, &end);
            rest = end;
        }
        program->set[constant.number] = 1;
        return !*rest;
    }
    for (size_t i = 0; i < sizeof names / sizeof *names; i++) known |= !strcmp(line, names[i]);
    if (!known || program->count == LINES) return 0;
    strcpy(step.name, line);
    for (int i = 0; *text; i++) {
        Operand operand;
        const char *rest = text + strspn(text, " -");
        int negated = rest > text && rest[-1] == '-';
        if (i == 4 || !(rest = read_register(rest, &operand))) return 0;
        if (!(rest = read_components(rest, i ? operand.swizzle : unused, i ? &ignored : &step.mask))) return 0;
        operand.negated = negated;
        if (i) step.from[step.sources++] = operand;
        else step.to = operand;
        if (*rest && *rest != ',') return 0;
        text = (char *)rest + (*rest == ',');
    }
    program->step[program->count++] = step;
    return 1;
}

/* ---- Probes: a subset of TOML. Unknown lines are errors, so no probe is drawn differently from its text. ---- */

/* Reads all numbers of a text, skips brackets and commas, and returns how many numbers it read. */
static int read_numbers(const char *text, double *numbers, int most) {
    int count = 0;
    while (*(text += strspn(text, "[], "))) {
        char *end;
        if (count == most) return most + 1;
        numbers[count++] = strtof(text, &end); /* reads `inf`, too; Windows's strtod does not */
        if (end == text) return -1;
        text = end;
    }
    return count;
}

static int read_word(const char *value, char word[16]) { return sscanf(value, "\"%15[^\"]\"", word) == 1; }

/* Reads `{ name = [numbers], ... }` into a corner. A vertex program numbers its inputs, as its two `dcl` lines say. */
static int read_attributes(const Probe *probe, const char *text, Vector corner[ATTRIBUTES]) {
    for (text += strspn(text, "{ "); *text && *text != '}'; text += strspn(text, ", ")) {
        char name[16], list[128];
        double numbers[4];
        int length = 0, count, slot = -1;
        if (sscanf(text, "%15[a-z0-9] = [%127[^]]]%n", name, list, &length) != 2 || !length) return 0;
        if ((count = read_numbers(list, numbers, 4)) < 1 || count > 4) return 0;
        if (!strcmp(name, "position")) slot = POSITION;
        else if (*name == 'v' && name[1] <= '1') slot = name[1] - '0' + (probe->vertex.count ? POSITION : COLOR0);
        else if (*name == 't' && name[1] <= '1' && !probe->vertex.count) slot = name[1] - '0' + COORDINATE0;
        if (slot < 0 || name[1] < '0' || (slot != POSITION && name[2])) return 0;
        for (int i = 0; i < 4; i++) corner[slot][i] = i < count ? (float)numbers[i] : (float)(i == 3);
        text += length;
    }
    return 1;
}

/* Reads a line `key = value` of a section; returns 0 if it does not know the line. */
static int read_line(Probe *probe, const char *section, const char *key, const char *value) {
    char word[16] = "";
    double numbers[256];
    int count = *value == '[' ? read_numbers(value, numbers, 256) : 0, i;
#define KEY(in, name) (!strcmp(section, in) && !strcmp(key, name))
    read_word(value, word);
    if (KEY("", "device")) return strcpy(probe->device, word), *word;
    if (KEY("[[texture]]", "slot")) return probe->textured = 1, !strcmp(value, "0");
    if (KEY("[[texture]]", "format")) return strcpy(probe->format, word), *word;
    if (KEY("[[texture]]", "raw")) return !strcmp(value, "true");
    if (KEY("[[texture]]", "filter")) return probe->linear = !strcmp(word, "linear");
    if (KEY("[[texture]]", "mipmaps")) return probe->automatic = !strcmp(word, "automatic");
    if (KEY("[[texture]]", "mip")) return strcpy(probe->mip, word), !strcmp(word, "nearest") || !strcmp(word, "linear");
    if (KEY("[[texture]]", "address")) return strcpy(probe->address, word), !strcmp(word, "border");
    if (KEY("[[texture]]", "lod_bias")) return probe->bias = strtod(value, NULL), 1;
    if (KEY("[[texture]]", "border")) return memcpy(probe->border, numbers, sizeof probe->border), count == 4;
    if (KEY("[[texture]]", "size") || KEY("[target]", "size")) {
        int *size = section[1] == '[' ? probe->texels : probe->size, most = section[1] == '[' ? 8 : TARGET;
        for (i = 0; i < 2 && count == 2; i++) size[i] = (int)numbers[i];
        return count == 2 && size[0] > 0 && size[0] <= most && size[1] > 0 && size[1] <= most;
    }
    if (KEY("[[texture]]", "texels")) {
        int texels = probe->texels[0] * probe->texels[1], channels = texels ? count / texels : 0;
        if (count != texels * channels || (channels != 3 && channels != 4)) return 0;
        for (i = 0; i < count; i++) probe->texel[i / channels][i % channels] = numbers[i];
        return 1;
    }
    if (!strcmp(section, "[vertex_constants]") && *key == 'c' && key[1] >= '0' && key[1] < '8' && !key[2]) {
        for (i = 0; i < 4 && count == 4; i++) probe->vertex.constant[key[1] - '0'][i] = (float)numbers[i];
        return probe->vertex.set[key[1] - '0'] = 1, count == 4;
    }
    if (KEY("[geometry]", "primitive")) return probe->strips = 3, !strcmp(word, "triangles");
    if (KEY("[geometry]", "attributes")) {
        /* These follow the vertices in the file; a vertex itself has only its position. */
        Vector common[ATTRIBUTES];
        memset(common, 0, sizeof common);
        if (!read_attributes(probe, value, common)) return 0;
        for (i = 0; i < probe->corners; i++)
            for (int a = COLOR0; a < ATTRIBUTES; a++)
                if (common[a][0] || common[a][1] || common[a][2] || common[a][3])
                    memcpy(probe->corner[i][a], common[a], sizeof(Vector));
        return probe->corners > 0;
    }
    if (KEY("[geometry]", "full_screen")) {
        static const char *const quad[4] = {"{ position = [-1, 1], t0 = [0, 0] }", "{ position = [1, 1], t0 = [1, 0] }",
                                            "{ position = [1, -1], t0 = [1, 1] }",
                                            "{ position = [-1, -1], t0 = [0, 1] }"};
        for (probe->corners = probe->strips = 4, i = 0; i < 4; i++) read_attributes(probe, quad[i], probe->corner[i]);
        return !strcmp(value, "true");
    }
    if (KEY("[target]", "format")) return !strcmp(word, "bgra8");
    if (KEY("[target]", "clear")) return !strcmp(value, "[0, 0, 0, 0]");
    if (KEY("[depth]", "format")) return probe->depth = 1, !strcmp(word, "d16");
    if (KEY("[depth]", "test")) return !strcmp(word, "less-equal");
    if (KEY("[depth]", "write")) return !strcmp(value, "true");
    return 0;
}

static void read_probe(const char *path, Probe *probe) {
    static char line[1 << 14];
    char section[32] = "";
    Program *program = NULL;
    int number = 0, fine = 1, listed = 0;
    FILE *file = fopen(path, "r");
    if (!file) die("cannot read %s: %s", path, strerror(errno));
    memset(probe, 0, sizeof *probe);
    for (int i = 0; i < 12; i++) probe->corner[i][POSITION][3] = 1;
    while (fine && fgets(line, sizeof line, file)) {
        line[strcspn(line, "\r\n")] = 0;
        number++;
        char *equals = strstr(line, " = ");
        Program *sources[] = {&probe->pixel, &probe->vertex};
        if (program && !strcmp(line, "\"\"\"")) program = NULL;
        else if (program && !program->major) {
            char stage;
            fine = sscanf(line, "%cs_%d_%d", &stage, &program->major, &program->minor) == 3 && program->major < 3;
            program->vertex = stage == 'v';
        } else if (program) fine = read_step(program, line);
        else if (listed && *line == ']') listed = 0;
        else if (listed) {
            fine =
                probe->corners < 12 && read_attributes(probe, line + strspn(line, " "), probe->corner[probe->corners]);
            probe->corners++;
        } else if (!*line || *line == '#') continue;
        else if (*line == '[') {
            fine = sscanf(line, "%31s", section) == 1;
            /* An input of a vertex program that is not set is 0, 0, 0, 1. */
            if (!strcmp(section, "[vertex]"))
                for (int i = 0; i < 12; i++) probe->corner[i][COLOR0][3] = 1;
        } else if (!equals) fine = 0;
        else {
            *equals = 0;
            if (!strcmp(line, "source") && !strcmp(equals + 3, "\"\"\""))
                program = sources[!strcmp(section, "[vertex]")];
            else if (!strcmp(line, "vertices") && !strcmp(equals + 3, "[")) listed = 1;
            else fine = read_line(probe, section, line, equals + 3);
        }
    }
    fclose(file);
    if (!fine) die("%s:%d: this line is not understood: no probe that the runner knows has such a one", path, number);
    if (!probe->pixel.count || !probe->size[0] || !probe->corners) die("%s is no probe", path);
}

/* ---- The interfaces. Each has `open_card`, which writes remarks on the card and its driver, and `draw`. ---- */

/* Packs the channels of a texel for a texture of 4 or 2 bytes per texel; signed channels are two's complement. */
static unsigned pack(const double texel[4], int narrow, int red, int blue) {
    unsigned code[4];
    for (int i = 0; i < 4; i++) code[i] = (unsigned)(int)texel[i] & 255;
    if (narrow) return code[0] << 11 | code[1] << 5 | code[2];
    return code[0] << red | code[1] << 8 | code[2] << blue | code[3] << 24;
}

#ifdef _WIN32
#include "direct3d9.h"
#else
#include "opengl.h"
#endif

/* ---- The table ---- */

static int by_name(const void *a, const void *b) { return strcmp(*(char *const *)a, *(char *const *)b); }

/* Lists the probes of a folder, or a single given file; returns how many there are. */
static int list_probes(const char *place, char *paths[256]) {
    int count = 0;
    DIR *listing = opendir(place);
    if (!listing && errno != ENOTDIR && errno != EINVAL) die("cannot read %s: %s", place, strerror(errno));
    for (struct dirent *entry; listing && count < 256 && (entry = readdir(listing));) {
        size_t length = strlen(entry->d_name);
        if (length < 6 || strcmp(entry->d_name + length - 5, ".toml")) continue;
        if (!(paths[count] = malloc(strlen(place) + length + 2))) die("no memory");
        sprintf(paths[count++], "%s/%s", place, entry->d_name);
    }
    if (listing) closedir(listing);
    else if ((paths[count] = malloc(strlen(place) + 1))) strcpy(paths[count++], place);
    for (int i = 0; i < count; i++)
        for (char *c = paths[i]; *c; c++)
            if (*c == '\\') *c = '/';
    qsort(paths, (size_t)count, sizeof *paths, by_name);
    if (!count) die("%s has no probes (*.toml)", place);
    return count;
}

/* Draws the probes and writes their codes to the table; returns how many probes were drawn. */
static int measure(char *const *paths, int count) {
    static Image image;
    static Probe probes[256];
    int drawn = 0;
    for (int i = 0; i < count; i++) read_probe(paths[i], &probes[i]);
    open_card();
    put("case,column,row,red,green,blue,alpha,depth\n");
    for (int i = 0; i < count; i++) {
        const Probe *probe = &probes[i];
        if (!draw(probe, &image)) {
            fprintf(stderr, "runner: skipped %s: %s\n", paths[i], reason);
            put("# skipped %s: %s\n", paths[i], reason);
            continue;
        }
        drawn++;
        for (int y = 0; y < probe->size[1]; y++)
            for (int x = 0; x < probe->size[0]; x++) {
                const unsigned char *c = image.color[y][x];
                put("\"%s\",%d,%d,%d,%d,%d,%d,", paths[i], x, y, c[0], c[1], c[2], c[3]);
                if (probe->depth) put("%d", image.depth[y][x]);
                put("\n");
            }
    }
    return drawn;
}

int main(int count, char **arguments) {
    char *paths[256];
    if (count != 3)
        die("usage: runner PROBES TABLE.csv\n"
            "  PROBES is the folder of a card, fixtures/probes/open/r200, or one of its files\n"
            "  TABLE.csv gets what this machine's card draws; it is written where the runner starts");
    if (strpbrk(arguments[2], "/\\"))
        die("%s: name a file without a folder: the table is written where the runner starts, so that its paths hold",
            arguments[2]);
    if (strpbrk(arguments[1], "\"\n")) die("the path of the probes has a quotation mark");
    if (!measure(paths, list_probes(arguments[1], paths))) die("no probe could be drawn; nothing was written");
    FILE *file = fopen(arguments[2], "wb");
    if (!file) die("cannot write %s: %s", arguments[2], strerror(errno));
    size_t kept = fwrite(table, 1, written, file);
    if (fclose(file) || kept != written) {
        remove(arguments[2]); /* no table is better than part of one */
        die("cannot write %s: %s", arguments[2], strerror(errno));
    }
    return 0;
}

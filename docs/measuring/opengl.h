/* OpenGL through GLX, a part of runner.c. ATI_fragment_shader runs ps_1_x on r200, unit by unit of that card;
 * ARB_fragment_program runs ps_2_0 and programs that only move; ARB_vertex_program runs vs_1_1. */
#include <GL/gl.h>
#include <GL/glx.h>

/* Functions beyond OpenGL 1.3, which the driver provides on request. */
/* clang-format off */
#define FUNCTIONS(F)                                                          \
    F(PFNGLGENPROGRAMSARBPROC, glGenProgramsARB)                              \
    F(PFNGLBINDPROGRAMARBPROC, glBindProgramARB)                              \
    F(PFNGLPROGRAMSTRINGARBPROC, glProgramStringARB)                          \
    F(PFNGLPROGRAMLOCALPARAMETER4FVARBPROC, glProgramLocalParameter4fvARB)    \
    F(PFNGLBINDFRAGMENTSHADERATIPROC, glBindFragmentShaderATI)                \
    F(PFNGLBEGINFRAGMENTSHADERATIPROC, glBeginFragmentShaderATI)              \
    F(PFNGLENDFRAGMENTSHADERATIPROC, glEndFragmentShaderATI)                  \
    F(PFNGLPASSTEXCOORDATIPROC, glPassTexCoordATI)                            \
    F(PFNGLSAMPLEMAPATIPROC, glSampleMapATI)                                  \
    F(PFNGLSETFRAGMENTSHADERCONSTANTATIPROC, glSetFragmentShaderConstantATI)  \
    F(PFNGLCOLORFRAGMENTOP1ATIPROC, glColorFragmentOp1ATI)                    \
    F(PFNGLALPHAFRAGMENTOP1ATIPROC, glAlphaFragmentOp1ATI)                    \
    F(PFNGLCOLORFRAGMENTOP2ATIPROC, glColorFragmentOp2ATI)                    \
    F(PFNGLALPHAFRAGMENTOP2ATIPROC, glAlphaFragmentOp2ATI)                    \
    F(PFNGLCOLORFRAGMENTOP3ATIPROC, glColorFragmentOp3ATI)                    \
    F(PFNGLALPHAFRAGMENTOP3ATIPROC, glAlphaFragmentOp3ATI)                    \
    F(PFNGLGENFRAGMENTSHADERSATIPROC, glGenFragmentShadersATI)                \
    F(PFNGLSECONDARYCOLOR3FPROC, glSecondaryColor3f)
/* clang-format on */
#define DECLARE(type, name) static type name##_;
FUNCTIONS(DECLARE)
static const char *extensions;
static int depth_bits, upward; /* upward: row 0 is drawn lowest */

static int has(const char *name) {
    size_t length = strlen(name);
    const char *found = strstr(extensions, name);
    while (found && found[length] && found[length] != ' ') found = strstr(found + length, name);
    return found != NULL;
}

/* An error of the X server ends the program, as other errors do. */
static int on_error(Display *display, XErrorEvent *event) {
    char text[128];
    XGetErrorText(display, event->error_code, text, sizeof text);
    die("the display refuses: %s (request %d.%d)", text, event->request_code, event->minor_code);
    return 0;
}

static void open_card(void) {
    /* Two buffers, so that no drawing is shown. */
    /* clang-format off */
    int wish[] = {GLX_DRAWABLE_TYPE, GLX_PBUFFER_BIT, GLX_RENDER_TYPE, GLX_RGBA_BIT, GLX_DOUBLEBUFFER, True,
                  GLX_RED_SIZE, 8, GLX_GREEN_SIZE, 8, GLX_BLUE_SIZE, 8, GLX_ALPHA_SIZE, 8, GLX_DEPTH_SIZE, 0, None};
    /* clang-format on */
    int size[] = {GLX_PBUFFER_WIDTH, TARGET, GLX_PBUFFER_HEIGHT, TARGET, None};
    int count = 0, bits[4], samples, chosen = -1;
    Display *display = XOpenDisplay(NULL);
    if (!display) die("no display: start it under X, or set DISPLAY");
    XSetErrorHandler(on_error);
    GLXFBConfig *all = glXChooseFBConfig(display, DefaultScreen(display), wish, &count);
    for (int i = 0; i < count; i++) { /* 8 bits per channel, no anti-aliasing, 16 bits of depth if possible */
        static const int what[4] = {GLX_RED_SIZE, GLX_GREEN_SIZE, GLX_BLUE_SIZE, GLX_ALPHA_SIZE};
        int depth = 0, fits = 1;
        for (int c = 0; c < 4; c++) glXGetFBConfigAttrib(display, all[i], what[c], &bits[c]), fits &= bits[c] == 8;
        glXGetFBConfigAttrib(display, all[i], GLX_SAMPLES, &samples);
        glXGetFBConfigAttrib(display, all[i], GLX_DEPTH_SIZE, &depth);
        if (fits && !samples && (chosen < 0 || (depth == 16 && depth_bits != 16))) chosen = i, depth_bits = depth;
    }
    if (chosen < 0) die("the display has no buffer (GLX 1.3, pbuffer) with 8 bits of red, green, blue and alpha");
    GLXContext context = glXCreateNewContext(display, all[chosen], GLX_RGBA_TYPE, NULL, True);
    GLXPbuffer buffer = context ? glXCreatePbuffer(display, all[chosen], size) : None;
    if (!buffer || !glXMakeContextCurrent(display, buffer, buffer, context)) die("the driver gives no OpenGL context");
    extensions = (const char *)glGetString(GL_EXTENSIONS);
    if (!extensions) die("the driver names no OpenGL extensions");
#define LOAD(type, name) name##_ = (type)glXGetProcAddressARB((const GLubyte *)#name);
    FUNCTIONS(LOAD)
    /* Direct3D draws pixels whose centers lie on an upper edge. If this driver draws those on a lower edge instead,
     * everything is drawn upside down. */
    unsigned char below[4];
    glViewport(0, 0, 2, 2);
    glClear(GL_COLOR_BUFFER_BIT);
    glRectf(-1, -1, 1, 0.5f);
    glReadPixels(0, 1, 1, 1, GL_RGBA, GL_UNSIGNED_BYTE, below);
    upward = !below[0];
    put("# card: %s\n# driver: %s, OpenGL %s\n# interface: OpenGL, GLX\n", (const char *)glGetString(GL_RENDERER),
        (const char *)glGetString(GL_VENDOR), (const char *)glGetString(GL_VERSION));
}

/* True if a ps_1_x program only moves values that it reads, so that no unit of a card computes with them. */
static int only_moves(const Program *program) {
    for (int i = 0; i < program->count; i++)
        if (strcmp(program->step[i].name, "mov") && strncmp(program->step[i].name, "tex", 3)) return 0;
    return 1;
}

/* ---- ATI_fragment_shader: an instruction is a color operation, an alpha operation, or both. ---- */

static int use_ati(const Program *program) {
    static const struct {
        const char *name;
        GLenum code;
    } codes[] = {{"mov", GL_MOV_ATI}, {"add", GL_ADD_ATI},  {"sub", GL_SUB_ATI},  {"mul", GL_MUL_ATI},
                 {"mad", GL_MAD_ATI}, {"lrp", GL_LERP_ATI}, {"dp3", GL_DOT3_ATI}, {"dp4", GL_DOT4_ATI}};
    static const GLuint scales[] = {GL_EIGHTH_BIT_ATI, GL_QUARTER_BIT_ATI, GL_HALF_BIT_ATI, 0,
                                    GL_2X_BIT_ATI,     GL_4X_BIT_ATI,      GL_8X_BIT_ATI};
    if (!has("GL_ATI_fragment_shader")) return refuse("the driver has no GL_ATI_fragment_shader");
    for (int i = 0; i < 8; i++)
        for (int c = 0; c < 4; c++)
            if (program->constant[i][c] < 0 || program->constant[i][c] > 1)
                return refuse("OpenGL's constants go from 0 to 1: needs Direct3D 9");
    for (int i = 0; i < program->count; i++) {
        const char *name = program->step[i].name;
        if (!strcmp(name, "texdepth") || !strcmp(name, "texkill") || !strcmp(name, "rcp"))
            return refuse("GL_ATI_fragment_shader has no %s: needs Direct3D 9", name);
    }
    glBindFragmentShaderATI_(glGenFragmentShadersATI_(1));
    glBeginFragmentShaderATI_();
    for (GLuint i = 0; i < 8; i++)
        if (program->set[i]) glSetFragmentShaderConstantATI_(GL_CON_0_ATI + i, program->constant[i]);
    for (const Step *step = program->step; step < program->step + program->count; step++) {
        GLuint from[3] = {0}, signs[3] = {0}, repeat[3] = {0};
        GLuint to = GL_REG_0_ATI + (GLuint)step->to.number + (step->to.kind == 't' ? 2 : 0); /* see `draw` */
        GLuint mask = step->mask == 15 ? GL_NONE : (GLuint)step->mask & 7, scale = scales[step->shift + 3];
        if (step->saturated) scale |= GL_SATURATE_BIT_ATI;
        if (!strncmp(step->name, "tex", 3)) {
            GLuint unit = GL_TEXTURE0 + (GLuint)(step->sources ? step->from[0].number : step->to.number);
            if (!strcmp(step->name, "texcrd")) glPassTexCoordATI_(to, unit, GL_SWIZZLE_STR_ATI);
            else glSampleMapATI_(to, unit, GL_SWIZZLE_STR_ATI);
            continue;
        }
        if (!strcmp(step->name, "phase")) continue; /* the second reads of coordinates start it */
        for (int i = 0; i < step->sources; i++) {
            const Operand *operand = &step->from[i];
            GLuint number = (GLuint)operand->number;
            from[i] = operand->kind == 'c'   ? GL_CON_0_ATI + number
                      : operand->kind == 't' ? GL_REG_2_ATI + number
                      : operand->kind == 'r' ? GL_REG_0_ATI + number
                      : number               ? GL_SECONDARY_INTERPOLATOR_ATI
                                             : GL_PRIMARY_COLOR;
            signs[i] = operand->negated ? GL_NEGATE_BIT_ATI : 0;
            if (operand->swizzle[0] == operand->swizzle[3]) repeat[i] = GL_RED + (GLuint)operand->swizzle[0];
        }
        for (size_t i = 0; i < sizeof codes / sizeof *codes; i++) {
            GLenum code = codes[i].code;
            if (strcmp(codes[i].name, step->name)) continue;
#define SOURCE(i) from[i], repeat[i], signs[i]
            if (step->mask & 7 && step->sources == 1) glColorFragmentOp1ATI_(code, to, mask, scale, SOURCE(0));
            if (step->mask & 7 && step->sources == 2)
                glColorFragmentOp2ATI_(code, to, mask, scale, SOURCE(0), SOURCE(1));
            if (step->mask & 7 && step->sources == 3)
                glColorFragmentOp3ATI_(code, to, mask, scale, SOURCE(0), SOURCE(1), SOURCE(2));
            if (step->mask & 8 && step->sources == 1) glAlphaFragmentOp1ATI_(code, to, scale, SOURCE(0));
            if (step->mask & 8 && step->sources == 2) glAlphaFragmentOp2ATI_(code, to, scale, SOURCE(0), SOURCE(1));
            if (step->mask & 8 && step->sources == 3)
                glAlphaFragmentOp3ATI_(code, to, scale, SOURCE(0), SOURCE(1), SOURCE(2));
        }
    }
    if (!strncmp(program->step[program->count - 1].name, "tex", 3)) { /* a shader needs an arithmetic instruction */
        glColorFragmentOp1ATI_(GL_MOV_ATI, GL_REG_0_ATI, GL_NONE, 0, GL_REG_0_ATI, GL_NONE, 0);
        glAlphaFragmentOp1ATI_(GL_MOV_ATI, GL_REG_0_ATI, 0, GL_REG_0_ATI, GL_NONE, 0);
    }
    glEndFragmentShaderATI_();
    if (glGetError()) return refuse("the driver refuses the program as a GL_ATI_fragment_shader");
    glEnable(GL_FRAGMENT_SHADER_ATI);
    return 1;
}

/* ---- ARB programs: the same instructions in another syntax. Constants are set from outside, as above. ---- */

static int use_arb(const Program *program, GLenum stage, const char *extension) {
    static char text[1 << 12];
    char *end = text;
    int vertex = program->vertex;
    GLuint name;
    if (!has(extension)) return refuse("the driver has no %s", extension);
    end += sprintf(end, "!!ARB%cp1.0\nTEMP r0, r1, r2, r3, r4, r5%s;\n", vertex ? 'v' : 'f',
                   program->minor == 1 && !vertex ? ", t0" : "");
    for (const Step *step = program->step; step < program->step + program->count; step++) {
        int reads = !strncmp(step->name, "tex", 3), scalar = !strcmp(step->name, "rcp");
        if (!strncmp(step->name, "dcl", 3)) continue;
        if (!strcmp(step->name, "texkill"))
            return refuse("OpenGL's KIL reads four components, whatever the card's texkill: needs Direct3D 9");
        if (step->shift || !strcmp(step->name, "texcrd") || !strcmp(step->name, "texdepth"))
            return refuse("not a program of OpenGL: needs Direct3D 9");
        for (const char *letter = reads ? "TEX" : step->name; *letter; letter++) *end++ = (char)toupper(*letter);
        end += sprintf(end, "%s ", step->saturated ? "_SAT" : "");
        for (int i = -1; i < step->sources; i++) {
            const Operand *operand = i < 0 ? &step->to : &step->from[i];
            if (operand->kind == 's') continue;
            end += sprintf(end, "%s%s", i < 0 ? "" : ", ", operand->negated ? "-" : "");
            if (operand->kind == 'r' || (operand->kind == 't' && !reads) || (reads && i < 0))
                end += sprintf(end, "%c%d", operand->kind, operand->number);
            else if (operand->kind == 'c') end += sprintf(end, "program.local[%d]", operand->number);
            else if (operand->kind == 'v' && vertex)
                end += sprintf(end, "vertex.%s", operand->number ? "color" : "position");
            else if (operand->kind == 'v')
                end += sprintf(end, "fragment.color.%s", operand->number ? "secondary" : "primary");
            else if (operand->kind == 't') end += sprintf(end, "fragment.texcoord[%d]", operand->number);
            else end += sprintf(end, "result.%s", operand->kind == 'P' ? "position" : "color");
            *end++ = '.';
            for (int c = 0; c < (i >= 0 && scalar ? 1 : 4); c++)
                if (i >= 0 || step->mask >> c & 1) *end++ = "xyzw"[i < 0 ? c : operand->swizzle[c]];
        }
        if (reads) end += sprintf(end, "%s, texture[0], 2D", step->sources ? "" : ", fragment.texcoord[0]");
        end += sprintf(end, ";\n");
    }
    sprintf(end, "%sEND", program->major == 1 && !vertex ? "MOV result.color, r0;\n" : "");
    glGenProgramsARB_(1, &name);
    glBindProgramARB_(stage, name);
    glProgramStringARB_(stage, GL_PROGRAM_FORMAT_ASCII_ARB, (GLsizei)strlen(text), text);
    if (glGetError())
        return refuse("the driver refuses the program: %s", (const char *)glGetString(GL_PROGRAM_ERROR_STRING_ARB));
    for (GLuint i = 0; i < 8; i++)
        if (program->set[i]) glProgramLocalParameter4fvARB_(stage, i, program->constant[i]);
    glEnable(stage);
    return 1;
}

static int make_texture(const Probe *probe) {
    static const GLenum sizes[] = {GL_TEXTURE_RED_SIZE, GL_TEXTURE_GREEN_SIZE, GL_TEXTURE_BLUE_SIZE};
    int narrow = !strcmp(probe->format, "bgr565"), is_signed = !strcmp(probe->format, "rgba8s"),
        snorm = has("GL_EXT_texture_snorm");
    GLfloat border[4];
    GLint made;
    if (is_signed && !snorm && !has("GL_NV_texture_shader"))
        return refuse("the driver has no signed texels (GL_EXT_texture_snorm)");
    glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_WRAP_S, *probe->address ? GL_CLAMP_TO_BORDER : GL_CLAMP_TO_EDGE);
    glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_WRAP_T, *probe->address ? GL_CLAMP_TO_BORDER : GL_CLAMP_TO_EDGE);
    glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MAG_FILTER, probe->linear ? GL_LINEAR : GL_NEAREST);
    /* The four mipmap filters have consecutive numbers: + 1 is linear within a level, + 2 between levels. */
    glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MIN_FILTER,
                    *probe->mip     ? GL_NEAREST_MIPMAP_NEAREST + probe->linear + 2 * (*probe->mip == 'l')
                    : probe->linear ? GL_LINEAR
                                    : GL_NEAREST);
    glTexParameteri(GL_TEXTURE_2D, GL_GENERATE_MIPMAP, probe->automatic);
    for (int i = 0; i < 4; i++) border[i] = (GLfloat)probe->border[i];
    glTexParameterfv(GL_TEXTURE_2D, GL_TEXTURE_BORDER_COLOR, border);
    glTexEnvf(GL_TEXTURE_FILTER_CONTROL, GL_TEXTURE_LOD_BIAS, (GLfloat)probe->bias);
    unsigned words[64];
    unsigned short halves[64];
    glPixelStorei(GL_UNPACK_ALIGNMENT, 1);
    for (int i = 0; i < 64; i++) {
        words[i] = pack(probe->texel[i], narrow, 0, 16);
        halves[i] = (unsigned short)words[i];
    }
    glTexImage2D(GL_TEXTURE_2D, 0,
                 narrow       ? has("GL_ARB_ES2_compatibility") ? GL_RGB565 : GL_RGB5
                 : !is_signed ? GL_RGBA8
                 : snorm      ? GL_RGBA8_SNORM
                              : GL_SIGNED_RGBA8_NV,
                 probe->texels[0], probe->texels[1], 0, narrow ? GL_RGB : GL_RGBA,
                 narrow      ? GL_UNSIGNED_SHORT_5_6_5
                 : is_signed ? GL_BYTE
                             : GL_UNSIGNED_BYTE,
                 narrow ? (const void *)halves : words);
    for (int i = 0; i < 3; i++) {
        glGetTexLevelParameteriv(GL_TEXTURE_2D, 0, sizes[i], &made);
        if (made != (narrow ? 5 + (i == 1) : 8)) return refuse("the driver stores %s in other bits", probe->format);
    }
    return glGetError() ? refuse("the driver has no texture of %s", probe->format) : 1;
}

static int draw(const Probe *probe, Image *image) {
    const int width = probe->size[0], height = probe->size[1], r200 = !strcmp(probe->device, "r200");
    unsigned char color[TARGET][TARGET][4];
    GLuint texture, depth[TARGET][TARGET];
    if (!strncmp(probe->device, "nv2", 3)) return refuse("register combiners have no Direct3D text: needs Direct3D 9");
    if (probe->depth && depth_bits != 16) return refuse("the depth buffer has %d bits, not 16", depth_bits);
    for (int i = 0; i < probe->corners; i++)
        for (int c = 0; c < 4; c++)
            if (probe->corner[i][COLOR0][c] < 0 || probe->corner[i][COLOR0][c] > 1)
                return refuse("OpenGL itself clamps the colors of its vertices: needs Direct3D 9");
    glDisable(GL_FRAGMENT_PROGRAM_ARB), glDisable(GL_VERTEX_PROGRAM_ARB), glDisable(GL_FRAGMENT_SHADER_ATI);
    glGetError();
    /* Register n of ATI_fragment_shader reads texture unit n: ps_1_1's t0 is the third register, after r0 and r1, and
     * its texture is bound to the third unit. */
    for (GLenum unit = GL_TEXTURE2; unit >= GL_TEXTURE0; unit -= 2) glActiveTexture(unit), glDisable(GL_TEXTURE_2D);
    if (r200 && probe->pixel.minor == 1) glActiveTexture(GL_TEXTURE2);
    glGenTextures(1, &texture);
    glBindTexture(GL_TEXTURE_2D, texture);
    if (probe->textured && !make_texture(probe)) return 0;
    if (probe->textured) glEnable(GL_TEXTURE_2D);
    if (probe->vertex.count && !use_arb(&probe->vertex, GL_VERTEX_PROGRAM_ARB, "GL_ARB_vertex_program")) return 0;
    if (r200 && !use_ati(&probe->pixel)) return 0;
    if (!r200 && probe->pixel.major == 1 && !only_moves(&probe->pixel))
        return refuse("OpenGL has no units of ps_1_x on this card: needs Direct3D 9");
    if (!r200 && !use_arb(&probe->pixel, GL_FRAGMENT_PROGRAM_ARB, "GL_ARB_fragment_program")) return 0;
    glViewport(0, 0, width, height);
    glDisable(GL_DITHER);
    glDepthFunc(GL_LEQUAL);
    (probe->depth ? glEnable : glDisable)(GL_DEPTH_TEST);
    glClear(GL_COLOR_BUFFER_BIT | GL_DEPTH_BUFFER_BIT);
    glBegin(probe->strips == 4 ? GL_TRIANGLE_FAN : GL_TRIANGLES);
    for (int i = 0; i < probe->corners; i++) {
        /* OpenGL's pixel centers lie half a pixel to the right and below, and its depths go from -w to w. */
        const Vector *corner = probe->corner[i];
        const float *p = corner[POSITION];
        glColor4fv(corner[COLOR0]);
        glSecondaryColor3f_(corner[COLOR1][0], corner[COLOR1][1], corner[COLOR1][2]);
        glMultiTexCoord4fv(GL_TEXTURE0, corner[COORDINATE0]);
        glMultiTexCoord4fv(GL_TEXTURE1, corner[COORDINATE1]);
        glVertex4f(p[0] + p[3] / (float)width, (p[1] - p[3] / (float)height) * (upward ? -1 : 1), 2 * p[2] - p[3],
                   p[3]);
    }
    glEnd();
    glPixelStorei(GL_PACK_ALIGNMENT, 1);
    glReadPixels(0, 0, width, height, GL_RGBA, GL_UNSIGNED_BYTE, color);
    if (probe->depth) glReadPixels(0, 0, width, height, GL_DEPTH_COMPONENT, GL_UNSIGNED_INT, depth);
    if (glGetError()) return refuse("the driver refuses to draw it");
    for (int y = 0; y < height; y++)
        for (int x = 0; x < width; x++) {
            int place = (upward ? y : height - 1 - y) * width + x;
            memcpy(image->color[y][x], &color[0][0][0] + 4 * place, 4);
            if (probe->depth) image->depth[y][x] = (int)((&depth[0][0])[place] >> 16);
        }
    return 1;
}

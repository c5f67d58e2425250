/**
 * The text syntax of Motet for editors. `grammar/syntax/src/motet.pest` is its definition; a test holds the two
 * against each other on all texts of the repository.
 */

/// <reference types="tree-sitter-cli/dsl" />
// @ts-check

const list = (rule) => seq(rule, repeat(seq(',', rule)));
const trailing = (rule) => seq(list(rule), optional(','));

// Words that are never a bare name.
const RESERVED = [
  'let', 'sequence', 'if', 'else', 'wait', 'until', 'monitor', 'when', 'then', 'during', 'try', 'catch', 'finally',
  'repeat', 'each', 'parallel', 'done', 'fail', 'cannot', 'replan', 'and', 'or', 'not', 'true', 'false', 'any',
];

// Control characters but the tab.
const CONTROL = '\\x00-\\x08\\x0a-\\x1f\\x7f';

module.exports = grammar({
  name: 'motet',

  extras: $ => [/[ \t\r\n]/, $.comment],

  word: $ => $.identifier,

  reserved: {
    global: _ => RESERVED,
  },

  conflicts: $ => [
    // `within 3 s` belongs to the call before it, unless a block follows.
    [$.deadline, $.timed],
    [$.call_step],
    [$.let_step],
    [$.wait],
    [$.end],
    [$._word, $.deadline],
    [$._word, $.timed],
    [$._word, $.deadline, $.timed],
    [$._word, $.retry],
  ],

  supertypes: $ => [$._declaration, $._step, $._clause],

  rules: {
    file: $ => repeat($._item),

    comment: _ => token(seq('//', optional(choice(/[^\/\n][^\n]*/, /\/\/[^\n]*/)))),
    doc: _ => token(seq('///', optional(/[^\/\n][^\n]*/))),

    _item: $ => seq(repeat($.doc), $._declaration),

    _declaration: $ => choice(
      $.policy, $.action, $.perception, $.kind, $.fluent, $.measure, $.failure, $.enumeration, $.entities,
      $.initially, $.closed_world,
    ),

    kind: $ => seq('kind', field('name', $._name), optional(seq(':', field('parent', $._name))), optional($.fields)),
    fields: $ => seq('{', optional(trailing($.parameter)), '}'),
    fluent: $ => seq('fluent', field('name', $._name), $.parameters),
    measure: $ => seq('measure', field('name', $._name), $.parameters, $.result),
    failure: $ => seq('failure', field('name', $._name)),
    enumeration: $ => seq('enum', field('name', $._name), $.cases),
    cases: $ => seq('{', trailing($._name), '}'),
    entities: $ => seq('entity', list(field('name', $._name)), ':', field('kind', $._name)),
    initially: $ => seq('initially', list($._expression)),
    closed_world: _ => seq('closed', 'world'),
    action: $ => seq('action', field('name', $._name), $.parameters, optional($.result), repeat($._clause)),
    perception: $ => seq('perception', field('name', $._name), $.parameters, optional($.result), repeat($._clause)),

    parameters: $ => seq('(', optional(trailing($.parameter)), ')'),
    parameter: $ => seq(
      field('name', $._name), ':', field('type', $._type), optional(seq('=', field('default', $._expression))),
    ),
    result: $ => seq('->', field('type', $._type)),
    _type: $ => choice($.list_type, alias($._name, $.type)),
    list_type: $ => seq('List', '<', $._type, '>'),

    // Contracts

    _clause: $ => choice(
      $.needs, $.makes, $.unsettles, $.motion, $.uses, $.takes, $.fails, $.lasts,
    ),
    needs: $ => seq('needs', list($.quantified)),
    makes: $ => seq('makes', list($.quantified)),
    unsettles: $ => seq('unsettles', list($.quantified)),
    motion: $ => seq('motion', $.call),
    uses: $ => seq('uses', list($._name)),
    takes: $ => seq('takes', $._expression, '..', $._expression),
    fails: $ => seq('fails', list($._name)),
    lasts: $ => seq('lasts', 'until', list($._name)),
    quantified: $ => seq(
      $._expression,
      optional(seq('for', 'each', field('name', $._name), ':', field('type', $._type))),
      optional(seq('when', $._expression)),
    ),

    // Policies and steps

    policy: $ => seq(
      'policy', field('name', $._name), optional($.parameters), optional($.result), optional($.for_robot),
      optional($.achieves), optional($.keeps), field('body', $.block), optional($.finally),
    ),
    for_robot: $ => seq('for', field('robot', $._name)),
    achieves: $ => seq('achieves', $._expression),
    keeps: $ => seq('keep', list($._kept)),
    _kept: $ => choice(
      seq('out', 'of', $._expression),
      seq('distance', '(', $._expression, ')', '>=', $._expression),
    ),
    block: $ => seq('{', repeat($._step), '}'),

    _step: $ => choice(
      $.sequence, $.if_else, $.monitor, $.try_catch, $.repeat, $.each, $.parallel, $.timed, $.keep,
      $.wait, $.end, $.let_step, $.call_step,
    ),

    finally: $ => seq('finally', $.block),

    call_step: $ => seq(choice($.call, alias($._word_call, $.call)), repeat($._modifier)),
    let_step: $ => seq('let', field('name', $._name), '=', field('value', $._expression), repeat($._modifier)),
    _modifier: $ => choice($.manner, $.deadline, $.retry),
    manner: $ => choice('slowly', 'gently', seq('at', $._literal_first)),
    deadline: $ => prec.dynamic(1, seq('within', $._expression)),
    retry: $ => prec.dynamic(1, seq('retry', $._expression)),

    sequence: $ => seq('sequence', field('name', $._name), $.block, optional($.finally)),
    if_else: $ => seq(
      'if', $._expression, $.block,
      repeat(seq('else', 'if', $._expression, $.block)),
      optional(seq('else', $.block)),
      optional($.finally),
    ),
    wait: $ => seq('wait', choice(seq('until', $._expression, optional($.deadline)), $._literal_first)),
    monitor: $ => seq(
      'monitor', choice(seq('{', repeat1($.when), '}'), $.when), 'during', $.block, optional($.finally),
    ),
    when: $ => seq('when', $._expression, optional(seq('for', $._expression)), 'then', $._reaction),
    _reaction: $ => choice($.pause, $.restart, $.resume, $.end),
    pause: $ => seq('pause', optional($.deadline)),
    restart: $ => seq('restart', $.at_most),
    resume: $ => seq('resume', $.at_most, $.block),
    at_most: $ => seq('at', 'most', $._expression),
    try_catch: $ => seq(
      'try', $.block,
      choice(seq(repeat1($.catch), optional($.finally)), $.finally),
    ),
    catch: $ => seq(
      'catch', choice('any', list($._name)), optional(seq('as', field('name', $._name))), $.block,
    ),
    repeat: $ => seq('repeat', $._expression, $.block, optional(seq('until', $._expression)), optional($.finally)),
    each: $ => seq(
      'each', field('name', $._name), 'in', $._expression, $.at_most, $.block, optional($.finally),
    ),
    keep: $ => seq($.keeps, $.block, optional($.finally)),
    parallel: $ => seq('parallel', '{', repeat1($.block), '}', optional($.finally)),
    timed: $ => seq('within', $._expression, $.block, optional($.finally)),
    end: $ => seq(choice('done', 'fail', 'cannot', 'replan'), optional($._said)),
    // A call there is the next step.
    _said: $ => prec.right(seq(
      choice(seq(repeat1('not'), $._operand), $._said_operand),
      repeat(seq($._infix, repeat('not'), $._operand)),
    )),
    _said_operand: $ => prec.left(seq($._atom, repeat(choice($.field, $.index)))),

    // Conditions and terms: one flat list of operands and operators, as the grammar of the compiler has it.

    _expression: $ => prec.right(seq(
      repeat('not'), $._operand, repeat(seq($._infix, repeat('not'), $._operand)),
    )),
    _literal_first: $ => prec.right(seq(
      $.quantity, repeat(seq($._infix, repeat('not'), $._operand)),
    )),
    _infix: $ => choice('or', 'and', $.operator),
    operator: _ => choice('==', '!=', '<=', '>=', '<', '>', '+', '-', '*', '/'),
    _operand: $ => prec.left(seq(choice($._atom, $.call), repeat(choice($.field, $.index)))),
    _atom: $ => choice(
      $.quantity, $.text, $.boolean, 'any', $.list, $.group, $._name, $.binding,
    ),
    group: $ => seq('(', $._expression, ')'),
    list: $ => seq('[', optional(trailing($._expression)), ']'),
    field: $ => seq('.', field('name', $._name)),
    index: $ => seq('[', $.number, ']'),
    boolean: _ => choice('true', 'false'),

    call: $ => seq(field('function', $._name), $.arguments),
    // Words of the language that may be the name of a call where they could go on with a step.
    _word_call: $ => seq(field('function', $._word), $.arguments),
    _word: $ => alias(choice('within', 'retry', 'slowly', 'gently', 'at', 'keep'), $.identifier),
    arguments: $ => seq('(', optional(trailing($.argument)), ')'),
    argument: $ => seq(optional(seq(field('name', $._name), ':')), $._expression),

    binding: _ => token(seq('$', choice(/[A-Za-z_][A-Za-z0-9_]*/, new RegExp(`\`[^$\`${CONTROL}][^\`${CONTROL}]*\``)))),

    _name: $ => choice($.identifier, $.quoted_name),
    identifier: _ => /[A-Za-z_][A-Za-z0-9_]*/,
    quoted_name: _ => token(new RegExp(`\`[^$\`${CONTROL}][^\`${CONTROL}]*\``)),

    quantity: $ => prec.right(seq($.number, optional($.unit))),
    number: _ => /-?[0-9]+(\.[0-9]+)?([eE][+-]?[0-9]+)?/,
    unit: _ => choice(
      '%', 'km/h', 'm/s', 'cm', 'mm', 'km', 'ms', 'min', 'rad', 'deg', 'kg', 'm', 's', 'h', 'g', 'N',
    ),

    text: $ => seq('"', repeat(choice($._characters, $.escape, $.interpolation)), token.immediate('"')),
    _characters: _ => token.immediate(prec(1, new RegExp(`[^"\\\\{}${CONTROL}]+`))),
    escape: _ => token.immediate(choice(/\\["\\nrt]/, /\\u\{[0-9A-Fa-f]{1,6}\}/, '{{', '}}')),
    interpolation: $ => seq(token.immediate('{'), $._expression, '}'),
  },
});
